// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Plane vectors. Angles are in radians, counter-clockwise positive.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace qmorph {

using Vec2 = Eigen::Vector2d;

inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// `v` turned a quarter to the left.
inline Vec2 left_of(const Vec2& v) { return {-v.y(), v.x()}; }

inline Vec2 rotated(const Vec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// Counter-clockwise angle from `a` to `b`, in (-pi, pi].
inline double signed_angle(const Vec2& a, const Vec2& b) { return std::atan2(cross(a, b), a.dot(b)); }

/// Counter-clockwise angle from `a` to `b`, in [0, 2 pi).
inline double ccw_angle(const Vec2& a, const Vec2& b) {
  const double angle = signed_angle(a, b);
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

/// Sine of the angle at `at` from `to_next` to `to_previous`; positive where the corner is strictly convex.
inline double corner_sine(const Vec2& at, const Vec2& to_next, const Vec2& to_previous) {
  const Vec2 a = to_next - at, b = to_previous - at;
  const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
  return lengths > 0 ? cross(a, b) / lengths : 0.0;
}

/// The same at the worst corner of a quad that runs counter-clockwise: its scaled Jacobian.
inline double smallest_corner_sine(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return std::min({corner_sine(a, b, d), corner_sine(b, c, a), corner_sine(c, d, b), corner_sine(d, a, c)});
}

}  // namespace qmorph
