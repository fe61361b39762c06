// SPDX-License-Identifier: GPL-2.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/regions.hpp"
#include "geometry/predicates.hpp"
#include "qmorph/error.hpp"

namespace qmorph {
namespace {

using Eigen::Vector3d;

/// Of the triangles: the box around them, twice their area as a vector, and without its direction.
struct Extent {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  Vector3d area = Vector3d::Zero();
  double length = 0;
};

Extent extent_of(const Patch& patch) {
  Extent extent;
  for (const auto& t : patch.triangles) {
    const Vector3d &a = patch.points[t[0]], &b = patch.points[t[1]], &c = patch.points[t[2]];
    for (const Vector3d* p : {&a, &b, &c}) extent.low = extent.low.cwiseMin(*p), extent.high = extent.high.cwiseMax(*p);
    const Vector3d area = (b - a).cross(c - a);
    extent.area += area;
    extent.length += area.norm();
  }
  return extent;
}

/// Axes of the plane with this normal. A coordinate plane gives coordinate axes, so that going there and
/// back changes no bit.
Plane axes_for(const Vector3d& normal) {
  Plane plane;
  Eigen::Index dominant = 0;
  normal.cwiseAbs().maxCoeff(&dominant);
  const double sign = normal[dominant] > 0 ? 1 : -1;
  Vector3d u = Vector3d::Unit((dominant + 1) % 3), v = Vector3d::Unit((dominant + 2) % 3);
  if (sign < 0) std::swap(u, v);
  const Vector3d unit = sign * Vector3d::Unit(dominant);
  if ((normal.normalized() - unit).norm() > 1e-15) {
    u = (u - u.dot(normal) / normal.squaredNorm() * normal).normalized();
    v = normal.cross(u).normalized();
  }
  plane.axis_u = u;
  plane.axis_v = v;
  return plane;
}

}  // namespace

std::optional<Plane> find_plane(const Patch& patch) {
  const Extent extent = extent_of(patch);
  const double size = (extent.high - extent.low).norm();
  Vector3d normal = extent.area;
  if (!(extent.length > 0))
    throw SurfaceError("its triangles have no area, near " + describe(extent.low) + "; the surface is degenerate",
                       {.kind = ErrorKind::no_area, .place = extent.low});
  if (!(normal.norm() > 0)) return {};
  // Noise out of the plane must not tilt a coordinate plane.
  for (int i = 0; i < 3; ++i)
    if (std::abs(normal[i]) < 1e-12 * normal.norm()) normal[i] = 0;
  Plane plane = axes_for(normal);
  const Vector3d unit = normal.normalized();
  // The origin lies in the plane, and is kept at zero along the axes of a coordinate plane.
  const bool tilted = (plane.axis_u.cwiseAbs().maxCoeff() < 1) || (plane.axis_v.cwiseAbs().maxCoeff() < 1);
  const Vector3d& first = patch.points[patch.triangles[0][0]];
  plane.origin = tilted ? first : Vector3d(first.dot(unit) * unit);

  const auto lies_outside = [&](const Vector3d& p) {
    return std::abs((p - first).dot(unit)) > kPlanarTolerance * size;
  };
  if (std::none_of(patch.points.begin(), patch.points.end(), lies_outside)) return plane;
  for (const auto& t : patch.triangles)
    for (Index v : t)
      if (lies_outside(patch.points[v])) return {};
  return plane;
}

}  // namespace qmorph
