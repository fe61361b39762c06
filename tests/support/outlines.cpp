// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/outlines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/sketch.hpp"

namespace qmorph::test {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

Vector2d polar(double radius, double angle) { return radius * Vector2d(std::cos(angle), std::sin(angle)); }

/// Corners around a centre: a regular polygon, or with random radii (down to `thinnest`) a star.
std::vector<Vector2d> around(Rng& rng, const Vector2d& centre, double radius, int corners, double thinnest) {
  std::vector<Vector2d> polygon;
  const double start = rng.between(0, 2 * kPi);
  for (int i = 0; i < corners; ++i)
    polygon.push_back(centre + polar(radius * rng.between(thinnest, 1), start + 2 * kPi * i / corners));
  return polygon;
}

std::vector<Vector2d> box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// A hole of random form in the disk.
void hole(Rng& rng, Sketch& sketch, const Vector2d& centre, double radius) {
  switch (rng.below(4)) {
    case 0:
      sketch.path(around(rng, centre, radius, rng.range(8, 20), 1), SegmentKind::boundary, true);
      break;
    case 1:
      sketch.path(around(rng, centre, radius, rng.range(3, 4), 1), SegmentKind::boundary, true);
      break;
    case 2:
      sketch.path(around(rng, centre, radius, rng.range(4, 9), 0.3), SegmentKind::boundary, true);
      break;
    default: {  // a narrow slot
      const Vector2d half = polar(radius, rng.between(0, kPi)), side = 0.1 * Vector2d(-half.y(), half.x());
      sketch.path({centre - half - side, centre + half - side, centre + half + side, centre - half + side},
                  SegmentKind::boundary, true);
    }
  }
}

void polygon(Rng& rng, Sketch& sketch) {
  sketch.path(around(rng, {0, 0}, 1, rng.range(3, 12), rng.chance(0.5) ? 0.3 : 0.8), SegmentKind::boundary, true);
}

void plate(Rng& rng, Sketch& sketch) {
  sketch.path(box(-1, -1, rng.between(0.5, 1), rng.between(0.5, 1)), SegmentKind::boundary, true);
  const int side = rng.range(1, 3);  // holes in the cells of a grid do not meet
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double cell = 1.5 / side;
      if (rng.chance(0.7))
        hole(rng, sketch, Vector2d(-1 + cell * (x + 0.5), -1 + cell * (y + 0.5)), cell * rng.between(0.1, 0.48));
    }
}

/// A corner of 2 to 12 degrees.
void wedge(Rng& rng, Sketch& sketch) {
  const double angle = rng.between(2, 12) * kPi / 180;
  sketch.size.largest *= 0.5;
  std::vector<Vector2d> corners{{-1, 0}, {1, 0}};
  if (rng.chance(0.5)) corners.push_back({1.2, std::tan(angle)});
  corners.push_back(Vector2d(-1, 0) + polar(rng.between(1.5, 2.2), angle));
  sketch.path(corners, SegmentKind::boundary, true);
}

/// Sharp teeth around a disk.
void spikes(Rng& rng, Sketch& sketch) {
  const int teeth = rng.range(3, 9);
  const double root = rng.between(0.15, 0.6), width = rng.between(0.05, 0.95);
  std::vector<Vector2d> corners;
  for (int i = 0; i < teeth; ++i) {
    const double step = 2 * kPi / teeth;
    corners.push_back(polar(1, step * i));
    corners.push_back(polar(root, step * (i + 0.5 * width)));
    if (width < 0.7) corners.push_back(polar(root, step * (i + 1 - 0.5 * width)));
  }
  sketch.path(corners, SegmentKind::boundary, true);
}

/// Two circles, off centre: the gap is down to a few hundredths wide, one element or less.
void ring(Rng& rng, Sketch& sketch) {
  const double inner = rng.between(0.3, 0.9), gap = rng.between(0.01, 1) * (1 - inner);
  sketch.path(around(rng, {0, 0}, 1, rng.range(24, 48), 1), SegmentKind::boundary, true);
  sketch.path(around(rng, polar(1 - inner - gap, rng.between(0, 2 * kPi)), inner, rng.range(16, 40), 1),
              SegmentKind::boundary, true);
}

/// Teeth and gaps of random width.
void comb(Rng& rng, Sketch& sketch) {
  std::vector<Vector2d> corners{{-1, -0.6}, {1, -0.6}};
  const int teeth = rng.range(2, 6);
  double x = 1;
  for (int i = 0; i < teeth; ++i) {
    const double step = 2.0 / teeth, gap = i + 1 < teeth ? step * rng.between(0.05, 0.6) : 0;
    corners.push_back({x, rng.between(0, 0.8)});
    corners.push_back({x - step + gap, rng.between(0, 0.8)});
    if (gap > 0) {
      const double floor = rng.between(-0.55, -0.2);
      corners.push_back({x - step + gap, floor});
      corners.push_back({x - step, floor});
    }
    x -= step;
  }
  sketch.path(corners, SegmentKind::boundary, true);
}

/// A thin body with a sharp tail in a channel, fine around it.
void channel(Rng& rng, Sketch& sketch) {
  const double coarse = sketch.size.largest * rng.between(1.5, 3);
  sketch.size = {.smallest = coarse / rng.between(5, 50),
                 .largest = coarse,
                 .growth = rng.between(0.1, 0.4),
                 .from = {-0.5, 0},
                 .to = {rng.chance(0.5) ? -0.5 : 0.3, 0}};
  sketch.filling.pattern = Filling::Pattern::cells;
  sketch.path(box(-1.2, -0.8, 1.2, 0.8), SegmentKind::boundary, true);
  std::vector<Vector2d> body;
  const double thick = rng.between(0.03, 0.15);
  const int steps = 12;
  for (int i = 0; i < 2 * steps; ++i) {
    const double turn = 2 * kPi * (i + 0.5) / (2 * steps), along = 0.5 * (1 + std::cos(turn));
    body.push_back({-0.5 + 0.7 * along, (i < steps ? 1 : -1) * thick * std::sqrt(along) * (1.02 - along)});
  }
  body.push_back({0.22, 0});
  std::reverse(body.begin(), body.end());
  sketch.path(body, SegmentKind::boundary, true);
}

/// Graded 1:50 towards a point or a line, which may lie on the boundary.
void graded(Rng& rng, Sketch& sketch) {
  const double coarse = rng.between(0.2, 0.5);
  const Vector2d at(rng.between(-0.8, 0.8), rng.chance(0.3) ? -1 : rng.between(-0.8, 0.8));
  sketch.size = {.smallest = coarse / 50, .largest = coarse, .growth = rng.between(0.15, 0.5), .from = at, .to = at};
  if (rng.chance(0.3)) sketch.size.to.x() += rng.between(-0.3, 0.3);
  sketch.filling.pattern = Filling::Pattern::cells;
  const std::vector<Vector2d> corners = box(-1, -1, 1, 1);
  if (at.y() == -1) {
    sketch.path({corners[0], at, corners[1], corners[2], corners[3]}, SegmentKind::boundary, true);
  } else {
    sketch.path(corners, SegmentKind::boundary, true);
    if (rng.chance(0.5)) sketch.fixed(at);
  }
}

/// Holes that touch one another, or the boundary, at a single node; parts that hang together by a node.
void pinched(Rng& rng, Sketch& sketch) {
  const double y = rng.between(-0.3, 0.3);
  if (rng.chance(0.3)) {  // two triangles or boxes tip to tip
    sketch.path({{-1, -1}, {0, y}, {-1, 1}}, SegmentKind::boundary, true);
    sketch.path({{0, y}, {1, -1}, {1, 0.5}}, SegmentKind::boundary, true);
    return;
  }
  const bool at_wall = rng.chance(0.5);
  if (at_wall)
    sketch.path({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, y}}, SegmentKind::boundary, true);
  else
    sketch.path(box(-1, -1, 1, 1), SegmentKind::boundary, true);
  double x = at_wall ? -1 : -0.7;
  for (int i = rng.range(1, 3); i > 0; --i) {  // a chain of diamonds, tip to tip
    const double width = rng.between(0.2, 0.5), height = rng.between(0.05, 0.4);
    sketch.path({{x, y}, {x + width / 2, y - height}, {x + width, y}, {x + width / 2, y + height}},
                SegmentKind::boundary, true);
    x += width;
  }
}

/// A band that is one to three elements wide, bent.
void ribbon(Rng& rng, Sketch& sketch) {
  const double width = sketch.size.largest * rng.between(0.3, 2.5), bend = rng.between(0, 0.6);
  std::vector<Vector2d> lower, upper;
  for (int i = 0; i <= 16; ++i) {
    const double x = -1 + i / 8.0, y = bend * std::sin(3 * x);
    const Vector2d normal = Vector2d(-3 * bend * std::cos(3 * x), 1).normalized();
    lower.push_back(Vector2d(x, y) - 0.5 * width * normal);
    upper.push_back(Vector2d(x, y) + 0.5 * width * normal);
  }
  lower.insert(lower.end(), upper.rbegin(), upper.rend());
  sketch.path(lower, SegmentKind::boundary, true);
}

/// Embedded lines: a star of slits, a loop, a chain to the wall, lines that cross; and embedded points.
void embedded(Rng& rng, Sketch& sketch) {
  sketch.path({{-1, -1}, {0, -1}, {1, -1}, {1, 1}, {-1, 1}}, SegmentKind::boundary, true);
  const Vector2d star(-0.5, -0.4);
  const int rays = rng.range(0, 7);
  const double start = rng.between(0, 2 * kPi);
  for (int i = 0; i < rays; ++i)
    sketch.path({star, star + polar(rng.between(0.1, 0.45), start + 2 * kPi * (i + rng.between(0, 0.6)) / rays)},
                SegmentKind::constraint, false);
  if (rng.chance(0.6)) {
    const int corners = rng.range(3, 9);
    const double thinnest = rng.between(0.3, 1);
    sketch.path(around(rng, {0.5, 0.5}, 0.4, corners, thinnest), SegmentKind::constraint, true);
  }
  if (rng.chance(0.6))
    sketch.path({{0, -1}, {rng.between(0.05, 0.2), -0.6}, {0.1, rng.between(-0.3, -0.1)}}, SegmentKind::constraint,
                false);
  if (rng.chance(0.5)) {  // two lines that cross at a node
    const Vector2d centre(0.5, -0.5), a = polar(rng.between(0.1, 0.38), rng.between(0, 3)),
                                      b = polar(0.3, rng.between(3.3, 6));
    sketch.path({centre - a, centre, centre + a}, SegmentKind::constraint, false);
    sketch.path({centre - b, centre, centre + b}, SegmentKind::constraint, false);
  }
  if (rng.chance(0.5)) sketch.path({{1, 1}, {0.95, 0.95}}, SegmentKind::constraint, false);  // into the corner
  for (int i = rng.range(0, 4); i > 0; --i) sketch.fixed({rng.between(-0.9, -0.1), rng.between(0.2, 0.9)});
}

/// Several materials: a grid of lines or nested loops from wall to wall.
void materials(Rng& rng, Sketch& sketch) {
  if (rng.chance(0.5)) {
    sketch.path(around(rng, {0, 0}, 1, rng.range(5, 24), 0.9), SegmentKind::boundary, true);
    for (double radius = 0.75; radius > 0.2; radius -= rng.between(0.1, 0.4))
      sketch.path(around(rng, {0, 0}, radius, rng.range(4, 24), 0.9), SegmentKind::constraint, true);
    return;
  }
  const std::vector<double> x{-1, rng.between(-0.8, -0.1), rng.between(0, 0.8), 1};
  const std::vector<double> y{-1, rng.between(-0.7, 0.7), 1};
  for (std::size_t j = 0; j < y.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i) {
      const int here = sketch.node({x[i], y[j]});
      const bool rim_x = j == 0 || j + 1 == y.size(), rim_y = i == 0 || i + 1 == x.size();
      if (i + 1 < x.size())
        sketch.line(here, sketch.node({x[i + 1], y[j]}), rim_x ? SegmentKind::boundary : SegmentKind::constraint);
      if (j + 1 < y.size())
        sketch.line(here, sketch.node({x[i], y[j + 1]}), rim_y ? SegmentKind::boundary : SegmentKind::constraint);
    }
}

/// An island in a hole in a plate: two parts.
void island(Rng& rng, Sketch& sketch) {
  sketch.path(box(-1, -1, 1, 1), SegmentKind::boundary, true);
  sketch.path(around(rng, {0, 0}, 0.8, rng.range(6, 20), 0.9), SegmentKind::boundary, true);
  sketch.path(around(rng, {0, 0}, 0.65, rng.range(3, 12), rng.between(0.4, 1)), SegmentKind::boundary, true);
}

struct Kind {
  const char* name;
  void (*draw)(Rng&, Sketch&);
};
constexpr Kind kKinds[] = {
    {"polygon", polygon},   {"plate", plate},         {"wedge", wedge},   {"spikes", spikes},   {"ring", ring},
    {"comb", comb},         {"channel", channel},     {"graded", graded}, {"pinched", pinched}, {"ribbon", ribbon},
    {"embedded", embedded}, {"materials", materials}, {"island", island},
};

}  // namespace

std::optional<Draft> drawn_domain(Rng& rng, std::string& name) {
  const Kind& kind = kKinds[rng.below(std::size(kKinds))];
  name = kind.name;
  Sketch sketch;
  const double triangles = 100 * rng.power_of_two(0, 4);
  sketch.size.largest = std::sqrt(2 / (0.433 * triangles));
  sketch.filling.turn = rng.chance(0.5) ? 0 : rng.between(0, 1.5);
  sketch.filling.jitter = rng.chance(0.3) ? 0 : rng.between(0, 0.8);
  if (rng.chance(0.25)) sketch.filling.pattern = Filling::Pattern::cells;
  if (rng.chance(0.06)) {  // coarse: corners only
    sketch.filling.pattern = Filling::Pattern::nothing;
    sketch.size.largest = rng.between(0.3, 10);
    name += " coarse";
  }
  kind.draw(rng, sketch);
  if (sketch.node_count() > 700) return std::nullopt;
  return sketch.build(rng);
}

}  // namespace qmorph::test
