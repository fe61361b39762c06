#pragma once
/// Exact signs. A decision that changes the mesh rests on these, never on an epsilon.

#include <algorithm>

#include "geometry/vec2.hpp"

namespace qmorph {

/// Sign of the area of the triangle a, b, c: 1 counter-clockwise, -1 clockwise, 0 exactly collinear.
/// Laws: the same for every rotation of the arguments, opposite when two are exchanged.
/// Exact unless a product of two coordinates over- or underflows. Floating-point filter after
/// [Shewchuk97], then an exact sum of the six products.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

inline bool is_ccw(const Vec2& a, const Vec2& b, const Vec2& c) { return orientation(a, b, c) > 0; }

/// A corner whose sine is not above this is straight, closed or turned over: an element with such a corner is
/// not valid. Far above the rounding of coordinates that were turned into their plane, far below what a
/// solver notices.
inline constexpr double kStraightSine = 1e-6;
/// The same for triangles: slivers of the input are tolerated, zero area is not.
inline constexpr double kDegenerateSine = 1e-10;

/// The corner at b of a polygon that runs a, b, c is convex by more than the sine given.
inline bool is_convex_corner(const Vec2& a, const Vec2& b, const Vec2& c, double least_sine) {
  const Vec2 to_next = c - b, to_previous = a - b;
  const double area = cross(to_next, to_previous);
  return area > 0 && area * area > least_sine * least_sine * to_next.squaredNorm() * to_previous.squaredNorm();
}

/// Every corner of the triangle is convex and its sine is above `sine`. No roots, no divisions: the smallest angle lies between
/// the two longest sides.
inline bool is_triangle_above(const Vec2& a, const Vec2& b, const Vec2& c, double sine) {
  const Vec2 ab = b - a, bc = c - b, ca = a - c;
  const double l1 = ab.squaredNorm(), l2 = bc.squaredNorm(), l3 = ca.squaredNorm(), area = cross(ab, bc);
  return area > 0 && area * area > sine * sine * std::max(std::max(l1 * l2, l2 * l3), l3 * l1);
}

}  // namespace qmorph
