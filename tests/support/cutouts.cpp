// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/cutouts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/triangulate.hpp"

namespace qmorph::test {
namespace {

using Eigen::Vector2d;

/// Squares cut along a diagonal: all the same way, in turn, or at random.
Draft squares(Rng& rng, int columns, int rows) {
  Draft draft;
  const int pattern = rng.range(0, 2);
  const double slant = rng.chance(0.5) ? 0 : rng.between(-0.5, 0.5), height = rng.between(0.3, 1);
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) draft.points.emplace_back(x + slant * y, height * y);
  const auto at = [&](int x, int y) { return Index(y * (columns + 1) + x); };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const Index a = at(x, y), b = at(x + 1, y), c = at(x + 1, y + 1), d = at(x, y + 1);
      const bool rising = pattern == 0 || (pattern == 1 ? (x + y) % 2 == 0 : rng.chance(0.5));
      if (rising)
        draft.triangles.insert(draft.triangles.end(), {{a, b, c}, {a, c, d}});
      else
        draft.triangles.insert(draft.triangles.end(), {{a, b, d}, {b, c, d}});
    }
  return draft;
}

/// The Delaunay triangulation of random points: bad shapes without end.
Draft cloud(Rng& rng, int count) {
  constexpr int kSize = 1 << 12;
  std::vector<LatticePoint> points{{0, 0}, {kSize, 0}, {kSize, kSize}, {0, kSize}};
  const std::int64_t apart = std::int64_t(kSize * rng.between(0.1, 0.7) / std::sqrt(count));
  for (int attempt = 0; attempt < 4 * count && int(points.size()) < count; ++attempt) {
    const LatticePoint p{rng.range(1, kSize - 1), rng.range(1, kSize - 1)};
    const bool free = std::none_of(points.begin(), points.end(), [&](const LatticePoint& q) {
      return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) < apart * apart;
    });
    if (free) points.push_back(p);
  }
  const auto mesh = triangulate(points, {{0, 1, SegmentKind::boundary},
                                         {1, 2, SegmentKind::boundary},
                                         {2, 3, SegmentKind::boundary},
                                         {3, 0, SegmentKind::boundary}});
  Draft draft;
  if (!mesh) return draft;
  for (const LatticePoint& p : points) draft.points.push_back(Vector2d(double(p.x), double(p.y)) / kSize);
  for (const auto& [a, b, c] : mesh->triangles) draft.triangles.push_back({Index(a), Index(b), Index(c)});
  return draft;
}

Vector2d centre(const Draft& draft, std::size_t t) {
  const auto& [a, b, c] = draft.triangles[t];
  return (draft.points[a] + draft.points[b] + draft.points[c]) / 3;
}

/// Takes triangles out: disks, half planes, single ones at random.
std::vector<char> mask(Rng& rng, const Draft& draft) {
  std::vector<char> keep(draft.triangles.size(), 1);
  Vector2d low = draft.points[0], high = low;
  for (const Vector2d& p : draft.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vector2d extent = high - low;
  const auto anywhere = [&] { return Vector2d(low + extent.cwiseProduct(Vector2d(rng.uniform(), rng.uniform()))); };
  const auto remove_if = [&](auto&& gone) {
    for (std::size_t t = 0; t < keep.size(); ++t)
      if (gone(centre(draft, t))) keep[t] = 0;
  };
  for (int i = rng.range(0, 4); i > 0; --i) {
    const Vector2d middle = anywhere();
    const double radius = extent.minCoeff() * rng.between(0.03, 0.25);
    remove_if([&](const Vector2d& p) { return (p - middle).norm() < radius; });
  }
  for (int i = rng.range(0, 3); i > 0; --i) {
    const Vector2d on = low + extent * rng.between(0.05, 0.2), normal(rng.uniform(), rng.uniform());
    const bool upper = rng.chance(0.5);
    remove_if(
        [&](const Vector2d& p) { return normal.dot(upper ? Vector2d(low + high - p - on) : Vector2d(p - on)) < 0; });
  }
  if (rng.chance(0.3)) {  // worm-eaten: pinched everywhere, regions of a few triangles
    const double share = rng.between(0.02, 0.35);
    remove_if([&](const Vector2d&) { return rng.chance(share); });
  }
  return keep;
}

}  // namespace

std::optional<Draft> cut_out_domain(Rng& rng, std::string& name) {
  const bool lattice = rng.chance(0.6);
  name = lattice ? "lattice" : "cloud";
  Draft draft = lattice ? squares(rng, rng.range(4, 28), rng.range(4, 28)) : cloud(rng, rng.range(30, 700));
  if (draft.triangles.empty()) return std::nullopt;
  std::vector<char> keep = mask(rng, draft);
  if (rng.chance(0.6)) keep_largest_part(draft, keep);
  keep_triangles(draft, keep);
  if (draft.triangles.size() < 5) return std::nullopt;
  return draft;
}

std::optional<Draft> tiny_domain(Rng& rng, std::string& name) {
  Draft draft;
  const int size = rng.range(1, 20);
  const auto on_circle = [&](int i, int count, double radius) {
    const double angle = 2 * std::numbers::pi * i / count;
    draft.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  };
  switch (rng.below(4)) {
    case 0: {  // a strip
      name = "strip";
      for (int i = 0; i < size + 2; ++i)
        draft.points.emplace_back(0.5 * i + rng.between(-0.2, 0.2), (i % 2) + rng.between(-0.2, 0.2));
      for (Index i = 0; i < Index(size); ++i)
        draft.triangles.push_back(i % 2 == 0 ? std::array<Index, 3>{i, i + 2, i + 1}
                                             : std::array<Index, 3>{i, i + 1, i + 2});
      break;
    }
    case 1: {  // a fan around a corner, of 10 to 350 degrees
      name = "fan";
      const int whole = std::max(size + 1, int(size * rng.between(1.03, 5)));
      draft.points.emplace_back(0, 0);
      for (int i = 0; i <= size; ++i) on_circle(i, std::max(whole, 3 * (size == 1)), rng.between(0.7, 1));
      for (Index i = 1; i <= Index(size); ++i) draft.triangles.push_back({0, i, i + 1});
      break;
    }
    case 2: {  // a wheel
      name = "wheel";
      const int spokes = std::max(3, size);
      draft.points.emplace_back(rng.between(-0.2, 0.2), rng.between(-0.2, 0.2));
      const double thinnest = rng.between(0.5, 1);
      for (int i = 0; i < spokes; ++i) on_circle(i, spokes, rng.between(thinnest, 1));
      for (int i = 0; i < spokes; ++i) draft.triangles.push_back({0, Index(1 + i), Index(1 + (i + 1) % spokes)});
      break;
    }
    default: {  // a star without inner nodes
      name = "star";
      const int corners = size + 2;
      std::vector<LatticePoint> points;
      std::vector<Segment> sides;
      const double thinnest = rng.between(0.3, 1);
      for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners, radius = 4096 * rng.between(thinnest, 1);
        points.push_back({std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle))});
        sides.push_back({i, (i + 1) % corners, SegmentKind::boundary});
      }
      const auto mesh = triangulate(points, sides);
      if (!mesh) return std::nullopt;
      for (const LatticePoint& p : points) draft.points.push_back(Vector2d(double(p.x), double(p.y)) / 4096);
      for (const auto& [a, b, c] : mesh->triangles) draft.triangles.push_back({Index(a), Index(b), Index(c)});
    }
  }
  return draft;
}

}  // namespace qmorph::test
