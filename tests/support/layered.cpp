// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/layered.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace qmorph::test {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

constexpr double kPi = std::numbers::pi;
constexpr double kNever = 10;  ///< no corner has a fan

/// What a kind of domain is made with.
struct Tools {
  Rng& rng;
  double spacing;
  LayerBuilder& builder;
  Sketch& sketch;
  std::string& kind;
};

/// Nodes above a wall, 3 to 40 rows, the first of 1e-6 to 1e-1 of the spacing, the last not higher than long.
std::vector<double> draw_heights(Rng& rng, double spacing, double thickness) {
  while (true) {
    const int rows = rng.range(3, 40);
    const double growth = rng.between(1.02, 1.9);
    const double first = thickness * (growth - 1) / (std::pow(growth, rows) - 1);
    if (first < 1e-6 * spacing || first > 0.1 * spacing || first * std::pow(growth, rows - 1) > 0.9 * spacing) continue;
    std::vector<double> heights{0};
    for (int k = 0; k < rows; ++k) heights.push_back(heights.back() + first * std::pow(growth, k));
    return heights;
  }
}

/// A polygon with nodes on its sides.
Points divided(const Points& corners, double spacing, bool closed) {
  Points nodes;
  const std::size_t sides = closed ? corners.size() : corners.size() - 1;
  for (std::size_t i = 0; i < sides; ++i) {
    const Vector2d &from = corners[i], &to = corners[(i + 1) % corners.size()];
    const int pieces = std::max(1, int(std::lround((to - from).norm() / spacing)));
    for (int k = 0; k < pieces; ++k) nodes.push_back(from + (to - from) * k / pieces);
  }
  if (!closed) nodes.push_back(corners.back());
  return nodes;
}

void draw_loop(Sketch& sketch, const Points& places) {
  std::vector<int> nodes;
  for (const Vector2d& p : places) nodes.push_back(sketch.node(p));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sketch.edge(nodes[i], nodes[(i + 1) % nodes.size()], SegmentKind::boundary);
}

void draw_path(Sketch& sketch, const Points& places) {
  for (std::size_t i = 1; i < places.size(); ++i)
    sketch.edge(sketch.node(places[i - 1]), sketch.node(places[i]), SegmentKind::boundary);
}

void draw_frame(Sketch& sketch) { sketch.path({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, SegmentKind::boundary, true); }

/// The fewest rows of a column beside which triangles that are as long as the spacing are not too flat.
std::size_t fewest_rows(const Tools& t, const std::vector<double>& heights) {
  std::size_t rows = heights.size() - 1;
  while (rows > 1 && heights[rows] - heights[rows - 1] > 0.1 * t.spacing) --rows;
  return rows;
}

/// Some neighbouring columns are lower than the others, by one row from each to the next.
void end_some_rows(Tools& t, const std::vector<double>& heights) {
  if (!t.rng.chance(0.3)) return;
  t.kind += " ending";
  const std::size_t least = fewest_rows(t, heights), most = heights.size() - 1;
  const std::size_t width = 3 + t.rng.below(6);
  if (width >= t.builder.lines()) return;
  const std::size_t first = t.rng.below(t.builder.lines() - width);
  for (std::size_t i = 0; i < width; ++i) {
    const std::size_t fewer = 1 + std::min(i, width - 1 - i);
    t.builder.set_rows(first + i, most - std::min(most - least, fewer));
  }
}

Points body_outline(Tools& t) {
  const int choice = t.rng.range(0, 4);
  Points outline;
  if (choice == 0) {
    t.kind += " smooth";
    const double a = t.rng.between(0.25, 0.6), b = t.rng.between(0.25, 0.6), wave = t.rng.between(0, 0.06);
    const int n = std::max(12, int(kPi * (a + b) / t.spacing)), waves = t.rng.range(2, 4);
    for (int i = 0; i < n; ++i) {
      const double angle = -2 * kPi * i / n, r = 1 + wave * std::sin(waves * angle);
      outline.emplace_back(a * r * std::cos(angle), b * r * std::sin(angle));
    }
  } else if (choice == 1) {
    t.kind += " foil";
    const double thick = t.rng.between(0.12, 0.35);
    const int n = std::max(5, int(1.2 / t.spacing));
    const auto at = [&](double u) {  // 0 at the nose, 1 at the sharp end
      return std::pair(-0.6 + 1.2 * u, thick * 1.2 *
                                           (1.4845 * std::sqrt(u) - 0.63 * u - 1.758 * u * u + 1.4215 * u * u * u -
                                            0.518 * u * u * u * u));
    };
    const auto share = [&](int i) { return std::pow(double(i) / n, 1.6); };
    for (int i = n; i >= 0; --i) outline.emplace_back(at(share(i)).first, -at(share(i)).second);
    for (int i = 1; i < n; ++i) outline.emplace_back(at(share(i)).first, at(share(i)).second);
  } else if (choice == 2) {
    t.kind += " polygon";
    const int corners = t.rng.range(3, 7);
    const double turn = t.rng.between(0, kPi), radius = t.rng.between(0.3, 0.55);
    for (int i = 0; i < corners; ++i) {
      const double angle = turn - 2 * kPi * (i + t.rng.between(-0.2, 0.2)) / corners;
      outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    outline = divided(outline, t.spacing, true);
  } else if (choice == 3) {
    t.kind += " concave";
    const double in = t.rng.between(0.15, 0.25), out = t.rng.between(0.45, 0.6);
    outline =
        divided({{in, in}, {out, in}, {out, -in}, {in, -in}, {in, -out}, {-in, -out}, {-in, in}}, t.spacing, true);
  } else {
    t.kind += " plate";
    t.builder.marks_walls = true;
    const int n = std::max(4, int(1 / t.spacing));
    for (int i = 0; i < n; ++i) outline.emplace_back(-0.5 + double(i) / n, 0);
    for (int i = 0; i < n; ++i) outline.emplace_back(0.5 - double(i) / n, 0);
  }
  return outline;
}

/// The smallest thickness over spacing that keeps the lines of a concave corner from their neighbours.
double most_thickness(const Points& outline) {
  double most = 2;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d a = outline[i] - outline[(i + n - 1) % n], b = outline[(i + 1) % n] - outline[i];
    const double turn = std::atan2(cross(a, b), a.dot(b));
    if (turn > 0.1) most = std::min(most, 0.45 / std::tan(turn / 2));
  }
  return most;
}

std::optional<LayeredDomain> body(Tools& t) {
  const Points outline = body_outline(t);
  const auto heights = draw_heights(t.rng, t.spacing, t.spacing * t.rng.between(0.15, most_thickness(outline)));
  add_wall(t.builder, outline, true, heights, t.rng.chance(0.8) ? 0.9 : 1.3, t.rng);
  end_some_rows(t, heights);
  draw_loop(t.sketch, t.builder.outer_rim());
  draw_frame(t.sketch);
  return t.builder.build(&t.sketch);
}

std::optional<LayeredDomain> cavity(Tools& t) {
  Points corners;
  if (t.rng.chance(0.3)) {
    t.kind += " step";
    const double x = t.rng.between(-0.3, 0.3), y = t.rng.between(-0.3, 0.3);
    corners = {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {x, 0.9}, {x, y}, {-0.9, y}};
  } else {
    const int count = t.rng.range(3, 7);
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * kPi * (i + t.rng.between(-0.2, 0.2)) / count;
      corners.emplace_back(0.9 * std::cos(angle), 0.9 * std::sin(angle));
    }
  }
  const Points outline = divided(corners, t.spacing, true);
  const auto heights = draw_heights(t.rng, t.spacing, t.spacing * t.rng.between(0.15, most_thickness(outline)));
  add_wall(t.builder, outline, true, heights, 0.9, t.rng);
  end_some_rows(t, heights);
  draw_loop(t.sketch, t.builder.outer_rim());
  return t.builder.build(&t.sketch);
}

/// A floor with a hill from side to side; the sides have nodes where the rows end.
std::optional<LayeredDomain> channel(Tools& t) {
  const double hill = t.rng.between(0, 0.15);
  Points floor;
  const int n = int(2 / t.spacing);
  for (int i = 0; i <= n; ++i) {
    const double x = -1 + 2.0 * i / n;
    floor.emplace_back(x, -0.6 + hill * std::pow(std::cos(kPi * x / 2), 4));
  }
  const auto heights = draw_heights(t.rng, t.spacing, t.spacing * t.rng.between(0.15, 3));
  add_wall(t.builder, floor, false, heights, kNever, t.rng);
  end_some_rows(t, heights);
  const Points rim = t.builder.outer_rim();
  draw_path(t.sketch, rim);
  t.sketch.path({rim.back(), {1, 0.5}, {-1, 0.5}, rim.front()}, SegmentKind::boundary, false);
  return t.builder.build(&t.sketch);
}

/// Two walls at a right angle: cells are small where they meet, and long along each of them.
std::optional<LayeredDomain> corner(Tools& t) {
  const auto low = draw_heights(t.rng, t.spacing, t.spacing * t.rng.between(0.3, 2));
  auto across = draw_heights(t.rng, t.spacing, t.spacing * t.rng.between(0.3, 2)), up = low;
  const auto go_on = [&](std::vector<double>& heights, double end) {
    const int pieces = std::max(1, int(std::lround((end - heights.back()) / t.spacing)));
    const double start = heights.back();
    for (int i = 1; i <= pieces; ++i) heights.push_back(start + (end - start) * i / pieces);
  };
  const std::size_t columns = across.size() - 1;
  go_on(across, 1.6);
  go_on(up, 1.2);
  for (std::size_t i = 0; i < across.size(); ++i) {
    const bool still = i == 0 || i + 1 == across.size();
    t.builder.add_line(Vector2d(-0.8 + across[i], -0.6), Vector2d(0, 1), up, still);
    if (i >= columns) t.builder.set_rows(i, low.size() - 1);
  }
  const Points rim = t.builder.outer_rim(columns);
  draw_path(t.sketch, rim);
  t.sketch.path({rim.back(), {0.8, 0.6}, rim.front()}, SegmentKind::boundary, false);
  return t.builder.build(&t.sketch);
}

/// Two walls that meet at a sharp angle; the rows of both end before, one after another.
std::optional<LayeredDomain> wedge(Tools& t) {
  const double half = t.rng.between(0.3, 0.6), free = 2 * t.spacing / std::sin(half),
               height = t.spacing / t.rng.between(3.5, 8);
  const Vector2d tip(-0.9, 0), low(std::cos(half), -std::sin(half)), high(low.x(), -low.y());
  const int rows = t.rng.range(3, 6);
  std::vector<double> heights;
  for (int k = 0; k <= rows; ++k) heights.push_back(k * height);
  const Points outline = divided({tip + 1.8 * high, tip, tip + 1.8 * low}, t.spacing, false);
  add_wall(t.builder, outline, false, heights, kNever, t.rng);
  std::size_t columns = 0;
  for (std::size_t i = 0; i + 1 < t.builder.lines(); ++i) {
    const double from_tip = std::min((outline[i] - tip).norm(), (outline[i + 1] - tip).norm());
    t.builder.set_rows(i, std::size_t(std::clamp((from_tip - free) / t.spacing, 0.0, double(rows))));
    columns += t.builder.rows(i) > 0;
  }
  if (columns < 8) return std::nullopt;  // fewer than four on a wall could be anything
  const Points rim = t.builder.outer_rim();
  draw_path(t.sketch, rim);
  t.sketch.path({rim.back(), rim.front()}, SegmentKind::boundary, false);
  return t.builder.build(&t.sketch);
}

/// In the middle of a domain, with triangles on all sides.
std::optional<LayeredDomain> strip(Tools& t) {
  const double height = t.spacing / t.rng.between(3.2, 5), bow = t.rng.between(-0.2, 0.2), turn = t.rng.between(0, kPi);
  const int rows = t.rng.range(3, 12), n = int(1.2 / t.spacing);
  std::vector<double> heights;
  for (int k = 0; k <= rows; ++k) heights.push_back((k - 0.5 * rows) * height);
  t.builder.float_free();
  const Eigen::Rotation2Dd rotation(turn);
  for (int i = 0; i <= n; ++i) {
    const double x = -0.6 + 1.2 * i / n;
    const Vector2d normal = Vector2d(2 * bow * x * kPi / 2, 1).normalized();
    t.builder.add_line(rotation * Vector2d(x, -bow * x * x * kPi / 2), rotation * normal, heights);
  }
  draw_loop(t.sketch, t.builder.whole_rim());
  draw_frame(t.sketch);
  return t.builder.build(&t.sketch);
}

/// The same without ends.
std::optional<LayeredDomain> ring(Tools& t) {
  const double radius = t.rng.between(0.4, 0.6), aspect = t.rng.between(3, 50);
  const int rows = t.rng.range(3, 20), n = int(2 * kPi * radius / t.spacing);
  const double height = std::min(t.spacing / aspect, 0.25 / rows);
  std::vector<double> heights;
  for (int k = 0; k <= rows; ++k) heights.push_back(k * height);
  t.builder.float_free();
  for (int i = 0; i < n; ++i) {
    const Vector2d out(std::cos(-2 * kPi * i / n), std::sin(-2 * kPi * i / n));
    t.builder.add_line(radius * out, out, heights);
  }
  t.builder.close();
  draw_loop(t.sketch, t.builder.outer_rim());
  draw_loop(t.sketch, t.builder.inner_rim());
  draw_frame(t.sketch);
  return t.builder.build(&t.sketch);
}

/// Structured from wall to wall in both directions, as transfinite surfaces are.
std::optional<LayeredDomain> block(Tools& t) {
  const auto divide = [&](double end) {
    auto near = draw_heights(t.rng, t.spacing, t.spacing * t.rng.between(0.3, 2));
    const auto far =
        t.rng.chance(0.5) ? draw_heights(t.rng, t.spacing, t.spacing * t.rng.between(0.3, 2)) : std::vector<double>{0};
    const double middle = end - near.back() - far.back(), start = near.back();
    const int pieces = int(std::lround(middle / t.spacing));
    for (int i = 1; i <= pieces; ++i) near.push_back(start + middle * i / pieces);
    for (std::size_t i = far.size() - 1; i-- > 0;) near.push_back(end - far[i]);
    return near;
  };
  const auto across = divide(t.rng.between(0.8, 1.6)), up = divide(t.rng.between(0.8, 1.6));
  const double lean = t.rng.between(-0.2, 0.2);
  t.builder.jitter = 0;
  for (double x : across) t.builder.add_line({x, 0}, {lean, 1}, up);
  return t.builder.build(nullptr);
}

}  // namespace

LayeredDomain layered_domain(std::uint64_t seed) {
  Rng rng(seed ^ 0x6c61796572u);
  using Kind = std::optional<LayeredDomain> (*)(Tools&);
  constexpr std::pair<const char*, Kind> kKinds[] = {
      {"body", body},     {"body", body},   {"body", body},   {"cavity", cavity}, {"channel", channel},
      {"corner", corner}, {"wedge", wedge}, {"strip", strip}, {"ring", ring},     {"block", block}};
  const auto& [name, draw] = kKinds[seed % std::size(kKinds)];
  while (true) {
    const double spacing = rng.between(0.08, 0.2);
    LayerBuilder builder(rng, spacing);
    builder.diagonals = Diagonals(rng.range(0, 3));
    builder.jitter = rng.chance(0.5) ? rng.between(0.01, 0.15) : 0;
    builder.marks_walls = rng.chance(0.5);
    Sketch sketch;
    sketch.size.smallest = sketch.size.largest = spacing;
    sketch.filling.turn = rng.between(0, kPi);
    std::string kind = name;
    Tools tools{rng, spacing, builder, sketch, kind};
    auto domain = draw(tools);
    if (!domain) continue;
    domain->kind = kind;
    return std::move(*domain);
  }
}

}  // namespace qmorph::test
