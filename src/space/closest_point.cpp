// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/closest_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

/// Sides that p is clearly inside of are left out: the closest point is on one that p is outside of.
OnTriangle closest_on_sides(const Vector3d& p, const std::array<const Vector3d*, 3>& corners,
                            const std::array<bool, 3>& is_inside_of) {
  OnTriangle best;
  best.distance2 = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (is_inside_of[i]) continue;
    const int j = (i + 1) % 3;
    const double at_j = closest_on_segment(p, *corners[i], *corners[j]);
    // From the nearer corner, so that a corner is met to the bit.
    const Vector3d point = at_j <= 0.5 ? Vector3d(*corners[i] + at_j * (*corners[j] - *corners[i]))
                                       : Vector3d(*corners[j] + (1 - at_j) * (*corners[i] - *corners[j]));
    const double distance2 = (p - point).squaredNorm();
    if (!(distance2 < best.distance2)) continue;
    best = {point, Vector3d::Zero(), distance2};
    best.weights[i] = 1 - at_j, best.weights[j] = at_j;
  }
  return best;
}

/// Weights of b and c for the foot on the plane, from the normal: in a needle the products of lengths by which
/// closest_on_triangle() tells them otherwise are equal but for rounding.
Eigen::Vector2d weights_in_needle(const Vector3d& ab, const Vector3d& ac, const Vector3d& ap) {
  const Vector3d normal = ab.cross(ac);
  return Eigen::Vector2d(normal.dot(ap.cross(ac)), normal.dot(ab.cross(ap))) / normal.squaredNorm();
}

}  // namespace

double closest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double length2 = ab.squaredNorm();
  return length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
}

OnTriangle closest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  constexpr double kNeedle2 = 1e-6;  // square of the sine at a
  constexpr double kClear = 1e-6;    // of the area: rounding does not reach so far where there is no needle
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), bb = ab.squaredNorm(), bc = ab.dot(ac), cc = ac.squaredNorm();
  // Inside if the foot on the plane has positive weights; their common divisor is the square of the doubled area.
  double at_b = cc * d1 - bc * d2, at_c = bb * d2 - bc * d1, area2 = bb * cc - bc * bc;
  const bool is_needle = area2 < kNeedle2 * bb * cc;
  if (is_needle) {
    const Eigen::Vector2d weights = weights_in_needle(ab, ac, ap);
    at_b = weights[0], at_c = weights[1], area2 = 1;
  }
  if (at_b > 0 && at_c > 0 && at_b + at_c < area2) {
    const double v = at_b / area2, w = at_c / area2;
    const Vector3d point = a + v * ab + w * ac;
    return {point, Vector3d(1 - v - w, v, w), (p - point).squaredNorm()};
  }
  const double clear = kClear * area2;
  return closest_on_sides(
      p, {&a, &b, &c},
      {!is_needle && at_c > clear, !is_needle && area2 - at_b - at_c > clear, !is_needle && at_b > clear});
}

}  // namespace qmorph::space
