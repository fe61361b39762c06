// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Exact signs. A decision that changes the mesh rests on these, never on an epsilon.

#include <algorithm>

#include "geometry/vec2.hpp"
#include "qmorph/export.hpp"

namespace qmorph {

/// Sign of the area of the triangle a, b, c: 1 counter-clockwise, -1 clockwise, 0 exactly collinear.
/// Laws: the same for every rotation of the arguments, opposite when two are exchanged.
/// Exact unless a product of two coordinates over- or underflows. Floating-point filter after
/// [Shewchuk97], then an exact sum of the six products.
QMORPH_API int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// A corner whose sine is not above this is straight, closed or turned over: an element with such a corner is
/// not valid. Far above the rounding of coordinates that were turned into their plane, far below what a
/// solver notices.
inline constexpr double kStraightSine = 1e-6;
/// The same for triangles: slivers of the input are tolerated, zero area is not.
inline constexpr double kDegenerateSine = 1e-10;

/// A surface is planar if no node is farther from its plane than this times its size. Large enough for coordinates written
/// with seven digits, small enough that the sagitta of real curvature shows.
inline constexpr double kPlanarTolerance = 1e-6;

/// The corner at b of a polygon that runs a, b, c is convex by more than the sine given.
inline bool is_convex_corner(const Vec2& a, const Vec2& b, const Vec2& c, double least_sine) {
  const Vec2 to_next = c - b, to_previous = a - b;
  const double area = cross(to_next, to_previous);
  return area > 0 && area * area > least_sine * least_sine * to_next.squaredNorm() * to_previous.squaredNorm();
}

/// Every corner of the triangle is convex and its sine is above `sine`. No roots, no divisions: the smallest angle lies
/// between the two longest sides.
inline bool is_triangle_above(const Vec2& a, const Vec2& b, const Vec2& c, double sine) {
  const Vec2 ab = b - a, bc = c - b, ca = a - c;
  const double l1 = ab.squaredNorm(), l2 = bc.squaredNorm(), l3 = ca.squaredNorm(), area = cross(ab, bc);
  return area > 0 && area * area > sine * sine * std::max(std::max(l1 * l2, l2 * l3), l3 * l1);
}

/// As is_triangle_above() for a quad; `least` is the sine's square. The same for all four ways to begin.
inline bool is_quad_above(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double least) {
  using Lanes = Eigen::Array2d;  // two sides or corners, so that the processor works on both at once
  const Vec2 ab = b - a, bc = c - b, cd = d - c, da = a - d;
  const Lanes x1{ab.x(), cd.x()}, y1{ab.y(), cd.y()}, x2{bc.x(), da.x()}, y2{bc.y(), da.y()};
  const Lanes x3{cd.x(), ab.x()}, y3{cd.y(), ab.y()};
  const Lanes l1 = x1 * x1 + y1 * y1, l2 = x2 * x2 + y2 * y2, l3{l1[1], l1[0]};
  const Lanes at_bd = x1 * y2 - y1 * x2, at_ca = x2 * y3 - y2 * x3;
  const Lanes bd = at_bd * at_bd.abs(), ca = at_ca * at_ca.abs();  // squares, negative where the corner is
  const Lanes least_bd = least * l1 * l2, least_ca = least * l2 * l3;
  return bd[0] > least_bd[0] && bd[1] > least_bd[1] && ca[0] > least_ca[0] && ca[1] > least_ca[1];
}

}  // namespace qmorph
