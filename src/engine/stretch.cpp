// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/stretch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace qmorph {
namespace {

/// Triangles are stretched at least that much in the mean; halves of rectangles of 2 to 1 look like 2.5.
constexpr double kLeast = 4;
/// From one to the next, it differs by no more than a factor like this, in the mean.
constexpr double kMostSpread = 2;

/// Logarithm of how much longer a triangle is in one direction than in the other, as a vector with twice that
/// direction's angle: opposite directions are the same, and those at a right angle cancel each other. Nothing of a
/// triangle without area.
std::optional<Vec2> log_stretch(const std::array<Vec2, 3>& corners) {
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 side = corners[(i + 1) % 3] - corners[i];
    xx += side.x() * side.x(), xy += side.x() * side.y(), yy += side.y() * side.y();
  }
  const Vec2 turn((xx - yy) / 2, xy);
  const double large = (xx + yy) / 2 + turn.norm(), small = (xx * yy - xy * xy) / large;
  if (!(small > 0)) return std::nullopt;
  if (!(turn.norm() > 0)) return Vec2(0, 0);
  return 0.5 * std::log(large / small) / turn.norm() * turn;
}

}  // namespace

Plane unstretched(const Plane& plane, const Patch& patch) {
  std::vector<Vec2> stretches;
  Vec2 mean(0, 0);
  for (const auto& t : patch.triangles) {
    std::array<Vec2, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = plane.to_plane(patch.points[t[i]]);
    const auto stretch = log_stretch(corners);
    if (!stretch) continue;
    stretches.push_back(*stretch);
    mean += *stretch;
  }
  mean /= double(std::max<std::size_t>(stretches.size(), 1));
  if (mean.norm() < std::log(kLeast)) return plane;
  double spread = 0;
  for (const Vec2& stretch : stretches) spread += (stretch - mean).norm();
  if (spread > std::log(kMostSpread) * double(stretches.size())) return plane;

  const double angle = std::atan2(mean.y(), mean.x()) / 2,
               root = std::exp(mean.norm() / 2);  // of each axis: areas stay
  const Eigen::Vector3d along = std::cos(angle) * plane.axis_u + std::sin(angle) * plane.axis_v;
  const Eigen::Vector3d across = std::cos(angle) * plane.axis_v - std::sin(angle) * plane.axis_u;
  Plane result = plane;
  result.axis_u = along * root;
  result.axis_v = across / root;
  result.dual_u = along / root;
  result.dual_v = across * root;
  return result;
}

}  // namespace qmorph
