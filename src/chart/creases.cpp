// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/creases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/sort_unique.hpp"

namespace qmorph::chart {
namespace {

/// The normal of a triangle that is not so high, relative to its longest side, says nothing.
constexpr double kLeastHeight = 0.02;

bool has_normal(const space::Background& surface, Index t) {
  double longest = 0;
  for (int i = 0; i < 3; ++i)
    longest = std::max(longest, (surface.corner(t, (i + 1) % 3) - surface.corner(t, i)).squaredNorm());
  const double area =
      (surface.corner(t, 1) - surface.corner(t, 0)).cross(surface.corner(t, 2) - surface.corner(t, 0)).norm();
  return area > kLeastHeight * longest;
}

}  // namespace

std::vector<std::pair<Index, Index>> find_creases(const space::Background& surface, double angle) {
  std::vector<std::pair<Index, Index>> creases;
  if (angle >= std::numbers::pi) return creases;
  const double least = std::cos(angle);
  std::vector<char> counts(surface.triangles(), 0);
  for (Index t = 0; t < surface.triangles(); ++t) counts[t] = has_normal(surface, t);
  for (Index side = 0; side < 3 * surface.triangles(); ++side) {
    const Index other = surface.opposite(side), t = side / 3;
    if (other == kNone || other < side || !counts[t] || !counts[other / 3]) continue;
    if (surface.normal(t).dot(surface.normal(other / 3)) >= least) continue;
    creases.push_back(std::minmax(surface.corners(t)[side % 3], surface.corners(t)[(side + 1) % 3]));
  }
  sort_unique(creases);
  return creases;
}

}  // namespace qmorph::chart
