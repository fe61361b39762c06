#pragma once
/// Exact signs. A decision that changes the mesh rests on these, never on an epsilon.

#include "geometry/vec2.hpp"

namespace qmorph {

/// Sign of the area of the triangle a, b, c: 1 counter-clockwise, -1 clockwise, 0 exactly collinear.
/// Laws: the same for every rotation of the arguments, opposite when two are exchanged.
/// Exact unless a product of two coordinates over- or underflows. Floating-point filter after
/// [Shewchuk97], then an exact sum of the six products.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

inline bool is_ccw(const Vec2& a, const Vec2& b, const Vec2& c) { return orientation(a, b, c) > 0; }

/// All four corners are strictly convex.
inline bool is_convex_quad(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return is_ccw(a, b, c) && is_ccw(b, c, d) && is_ccw(c, d, a) && is_ccw(d, a, b);
}

}  // namespace qmorph
