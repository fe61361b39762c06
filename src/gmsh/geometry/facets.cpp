// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/geometry/facets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "gmsh/geometry/cad_surface.hpp"
#include "space/background.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

/// Of each of two triangles, from its middle to the edge between them.
constexpr int kSteps = 4;
/// Of the angle between the triangles: along the way a normal turns by an eighth of it, if it does so evenly; at a
/// crease by all of it at once.
constexpr double kAtOnce = 0.5;

/// No edge can be sharper than `angle` where all normals around each node are within half of it from one of them.
bool may_be_sharp(const Patch& patch, double angle) {
  const double least = std::cos(angle / 2);
  std::vector<Vector3d> first(patch.points.size(), Vector3d::Zero());
  for (const auto& t : patch.triangles) {
    const Vector3d &a = patch.points[t[0]], &b = patch.points[t[1]], &c = patch.points[t[2]];
    const Vector3d normal = (b - a).cross(c - a).normalized();
    for (const Index v : t) {
      if (first[v].isZero()) first[v] = normal;
      if (!(first[v].dot(normal) >= least)) return true;
    }
  }
  return false;
}

/// Sides of triangles whose neighbour there is at a larger angle, one for each edge.
std::vector<Index> sharp_sides(const space::Background& triangles, double angle) {
  std::vector<Index> sides;
  for (Index side = 0; side < 3 * triangles.triangles(); ++side) {
    const Index other = triangles.opposite(side);
    if (other == kNone || other < side) continue;
    if (triangles.normal(side / 3).dot(triangles.normal(other / 3)) < std::cos(angle)) sides.push_back(side);
  }
  return sides;
}

/// From the middle of a triangle to that of its side.
void add_way(const SurfacePart& part, Index side, std::vector<OnInput>& places) {
  const auto& corners = part.patch.triangles[side / 3];
  Vector3d middle_of_side = Vector3d::Constant(0.5);
  middle_of_side[(side + 2) % 3] = 0;
  for (int k = 0; k <= kSteps; ++k) {
    const double share = double(k) / kSteps;
    OnInput place{.point = Vector3d::Zero(),
                  .weights = (1 - share) * Vector3d::Constant(1.0 / 3) + share * middle_of_side,
                  .corners = {}};
    for (int i = 0; i < 3; ++i) {
      place.point += place.weights[i] * part.patch.points[corners[std::size_t(i)]];
      place.corners[std::size_t(i)] = part.rows[corners[std::size_t(i)]];
    }
    places.push_back(place);
  }
}

bool turns_at_once(const CadSurface& geometry, const SurfacePart& part, const space::Background& triangles,
                   Index side) {
  std::vector<OnInput> here, there;
  add_way(part, side, here);
  add_way(part, triangles.opposite(side), there);
  here.insert(here.end(), there.rbegin(), there.rend());
  const std::vector<Vector3d> normals = geometry.normals(here);
  const double whole =
      std::acos(std::clamp(triangles.normal(side / 3).dot(triangles.normal(triangles.opposite(side) / 3)), -1.0, 1.0));
  for (std::size_t i = 0; i + 1 < normals.size(); ++i)
    if (!(normals[i].dot(normals[i + 1]) > std::cos(kAtOnce * whole))) return true;
  return false;
}

}  // namespace

bool has_only_facets(const ModelMesh& mesh, const SurfaceMesh& surface, double angle) {
  if (!CadSurface::may_be_found(mesh, surface.entity)) return false;
  std::unique_ptr<CadSurface> geometry;
  for (const SurfacePart& part : surface.parts) {
    if (!may_be_sharp(part.patch, angle)) continue;
    const std::vector<space::Background::Edge> barriers(part.patch.constraints.begin(), part.patch.constraints.end());
    const space::Background triangles(part.patch.points, part.patch.triangles, barriers);
    for (const Index side : sharp_sides(triangles, angle)) {
      if (!geometry) geometry = CadSurface::find(mesh, surface.entity);
      if (!geometry || turns_at_once(*geometry, part, triangles, side)) return false;
    }
  }
  return geometry != nullptr;
}

}  // namespace qmorph::adapter
