// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/nasty.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include "support/draft.hpp"
#include "support/sketch.hpp"
#include "support/spoil.hpp"

namespace qmorph::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Flatter triangles are another matter: the angles of their quads are too small for any solver.
constexpr double kFlattest = 1e-4;
constexpr std::size_t kMostTriangles = 3000;

Vector2d on_circle(double share, double radius) {
  const double angle = 2 * std::numbers::pi * share;
  return radius * Vector2d(std::cos(angle), std::sin(angle));
}

/// A disc around its middle, or a shell around a node of its outline.
Draft hub(Rng& rng) {
  Draft draft;
  const bool inside = rng.chance(0.5);
  const auto count = Index(rng.range(10, rng.chance(0.2) ? 400 : 80));
  const double thinnest = rng.chance(0.5) ? 1 : rng.between(0.4, 1);
  if (inside) draft.points.emplace_back(rng.between(-0.2, 0.2), rng.between(-0.2, 0.2));
  for (Index i = 0; i < count; ++i)
    draft.points.push_back(on_circle(double(i) / count, inside ? rng.between(thinnest, 1) : 1));
  if (inside)
    for (Index i = 0; i < count; ++i) draft.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  else
    for (Index i = 1; i + 1 < count; ++i) draft.triangles.push_back({0, i, i + 1});
  return draft;
}

/// A straight row of nodes, all joined to one on each side.
Draft kite(Rng& rng) {
  Draft draft;
  const auto count = Index(rng.range(3, 100));
  for (Index i = 0; i < count; ++i) draft.points.emplace_back(double(i) / count, 0);
  draft.points.emplace_back(rng.between(0, 1), rng.between(0.05, 1));
  draft.points.emplace_back(rng.between(0, 1), -rng.between(0.05, 1));
  for (Index i = 0; i + 1 < count; ++i) {
    draft.triangles.push_back({i, i + 1, count});
    draft.triangles.push_back({i + 1, i, count + 1});
  }
  return draft;
}

std::vector<Vector2d> ring(Rng& rng, int corners, double radius, const Vector2d& middle) {
  std::vector<Vector2d> places;
  const double turn = rng.uniform();
  for (int i = 0; i < corners; ++i) places.push_back(middle + on_circle(turn + double(i) / corners, radius));
  return places;
}

/// An outline with holes, finely divided, and nothing inside.
std::optional<Draft> hollow(Rng& rng) {
  Sketch sketch;
  sketch.filling.pattern = Filling::Pattern::nothing;
  sketch.size.smallest = sketch.size.largest = rng.between(0.02, 0.3);
  sketch.path(ring(rng, rng.range(3, 8), 1, {0, 0}), SegmentKind::boundary, true);
  for (int holes = rng.range(0, 3); holes > 0; --holes) {
    sketch.size.smallest = sketch.size.largest = rng.between(0.01, 0.1);
    const Vector2d middle = on_circle(holes / 3.0, 0.25);
    sketch.path(ring(rng, rng.range(3, 12), rng.between(0.02, 0.15), middle), SegmentKind::boundary, true);
  }
  return sketch.build(rng);
}

/// A band round a hole that is far thinner than its edges are long, or far finer divided on one side.
std::optional<Draft> gap(Rng& rng) {
  Sketch sketch;
  sketch.filling.pattern = Filling::Pattern::nothing;
  const int corners = rng.range(4, 60);
  const double width = rng.power_of_two(-8, -2);
  sketch.size.smallest = sketch.size.largest = rng.between(0.02, 1);
  auto outer = ring(rng, corners, 1, {0, 0});
  sketch.path(outer, SegmentKind::boundary, true);
  sketch.size.smallest = sketch.size.largest = rng.between(0.02, 1);
  for (Vector2d& p : outer) p *= 1 - width;
  sketch.path(outer, SegmentKind::boundary, true);
  return sketch.build(rng);
}

/// A corner of one to ten degrees.
std::optional<Draft> needle(Rng& rng) {
  Sketch sketch;
  sketch.filling.pattern = rng.chance(0.5) ? Filling::Pattern::nothing : Filling::Pattern::rows;
  sketch.size.smallest = sketch.size.largest = rng.between(0.03, 0.3);
  const double angle = rng.between(1, 10) / 360;
  sketch.path({{-1, 0}, on_circle(-angle, 1) + Vector2d(0, -0.1), {1, rng.between(0, 0.5)}}, SegmentKind::boundary,
              true);
  return sketch.build(rng);
}

/// Diamonds in a row, each touching the next, perhaps the outline too.
std::optional<Draft> chain_of_holes(Rng& rng) {
  Sketch sketch;
  sketch.filling.pattern = rng.chance(0.5) ? Filling::Pattern::nothing : Filling::Pattern::rows;
  sketch.size.smallest = sketch.size.largest = rng.between(0.05, 0.3);
  sketch.path({{-1, -0.5}, {0, -0.5}, {1, -0.5}, {1, 0}, {1, 0.5}, {-1, 0.5}, {-1, 0}}, SegmentKind::boundary, true);
  const int count = rng.range(2, 5);
  const double reach = rng.chance(0.3) ? 1 : 0.8, half = reach / count;
  for (int i = 0; i < count; ++i) {
    const double x = -reach + (2 * i + 1) * half;
    sketch.path({{x - half, 0}, {x, -rng.between(0.05, 0.4)}, {x + half, 0}, {x, rng.between(0.05, 0.4)}},
                SegmentKind::boundary, true);
  }
  return sketch.build(rng);
}

/// Lines that stand on the boundary or free, side by side.
std::optional<Draft> slits(Rng& rng) {
  Sketch sketch;
  sketch.filling.pattern = rng.chance(0.3) ? Filling::Pattern::nothing : Filling::Pattern::rows;
  const int count = rng.range(1, 8);
  sketch.size.smallest = sketch.size.largest = rng.between(0.04, 0.4);
  std::vector<Vector2d> outline{{-1, -0.5}};
  for (int i = 1; i <= count; ++i) outline.emplace_back(-1 + 2.0 * i / (count + 1), -0.5);
  for (const Vector2d& corner : {Vector2d(1, -0.5), Vector2d(1, 0.5), Vector2d(-1, 0.5)}) outline.push_back(corner);
  sketch.path(outline, SegmentKind::boundary, true);
  for (int i = 1; i <= count; ++i) {
    const double foot = rng.chance(0.7) ? -0.5 : -0.4;
    sketch.path({{outline[std::size_t(i)].x(), foot}, {outline[std::size_t(i)].x(), rng.between(-0.3, 0.45)}},
                SegmentKind::constraint, false);
  }
  return sketch.build(rng);
}

/// A grid in which most pairs of triangles are quads already.
Draft among_quads(Rng& rng) {
  Draft draft;
  const auto columns = Index(rng.range(2, 14)), rows = Index(rng.range(2, 14));
  for (Index y = 0; y <= rows; ++y)
    for (Index x = 0; x <= columns; ++x)
      draft.points.emplace_back(x + rng.between(-0.24, 0.24), y + rng.between(-0.24, 0.24));
  const double share = rng.between(0.3, 0.95);
  for (Index y = 0; y < rows; ++y)
    for (Index x = 0; x < columns; ++x) {
      const Index a = y * (columns + 1) + x, b = a + 1, d = a + columns + 1, c = d + 1;
      if (rng.chance(share) && (x > 0 || y > 0))
        draft.quads.push_back({a, b, c, d});
      else if (rng.chance(0.5))
        draft.triangles.insert(draft.triangles.end(), {{a, b, c}, {a, c, d}});
      else
        draft.triangles.insert(draft.triangles.end(), {{a, b, d}, {b, c, d}});
    }
  return draft;
}

std::optional<Draft> draw(Rng& rng, std::string& kind) {
  const auto named = [&](const char* name) { kind = name; };
  switch (rng.below(8)) {
    case 0:
      return named("hub"), hub(rng);
    case 1:
      return named("kite"), kite(rng);
    case 2:
      return named("hollow"), hollow(rng);
    case 3:
      return named("gap"), gap(rng);
    case 4:
      return named("needle"), needle(rng);
    case 5:
      return named("touching"), chain_of_holes(rng);
    case 6:
      return named("slits"), slits(rng);
    default:
      return named("scattered"), among_quads(rng);
  }
}

Patch posed(const Draft& draft, Rng& rng) {
  Patch patch;
  for (const Vector2d& p : draft.points) patch.points.emplace_back(p.x(), p.y(), 0);
  patch.triangles = draft.triangles;
  patch.quads = draft.quads;
  patch.constraints = draft.constraints;
  patch.fixed = draft.fixed;
  const double scale = std::pow(10, rng.range(-6, 6)), away = std::pow(10, rng.range(-1, 4));
  const Vector3d shift = scale * away * Vector3d(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1));
  const Eigen::Matrix3d turn = rng.chance(0.5) ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : random_rotation(rng);
  patch = moved(std::move(patch), scale, turn, rng.chance(0.5) ? shift : Vector3d::Zero());
  if (rng.chance(0.3)) patch = turned_over(std::move(patch));
  if (rng.chance(0.5)) patch = renumbered(patch, rng);
  return patch;
}

}  // namespace

Domain nasty_domain(std::uint64_t seed) {
  Rng rng(seed);
  Domain domain;
  while (true) {
    std::optional<Draft> draft = draw(rng, domain.kind);
    if (!draft || draft->triangles.empty() || draft->triangles.size() > kMostTriangles) continue;
    if (worst_flatness(*draft) < kFlattest) continue;
    if (draft->quads.empty() && rng.chance(0.2)) jitter_nodes(*draft, rng, rng.between(0.1, 1), kFlattest);
    if (draft->quads.empty() && rng.chance(0.2)) fix_nodes(*draft, rng, rng.range(1, 5));
    domain.patch = posed(*draft, rng);
    return domain;
  }
}

}  // namespace qmorph::test
