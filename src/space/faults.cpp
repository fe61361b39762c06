// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/faults.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/describe.hpp"
#include "geometry/predicates.hpp"
#include "space/mesh_normals.hpp"
#include "space/result.hpp"

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

template <std::size_t N>
constexpr double kLeastSine = N == 3 ? kDegenerateSine : kStraightSine;

template <std::size_t N>
Corners<N> corners_of(std::span<const Vector3d> points, const std::array<Index, N>& nodes) {
  Corners<N> corners;
  for (std::size_t i = 0; i < N; ++i) corners[i] = points[nodes[i]];
  return corners;
}

/// Nodes less edges plus elements.
long characteristic(std::size_t nodes, std::span<const std::array<Index, 3>> triangles,
                    std::span<const std::array<Index, 4>> quads) {
  const ElementSides sides(nodes, triangles, quads);
  std::vector<char> used(nodes, 0);
  long count = long(sides.elements());
  for (Index side = 0; side < sides.slots(); ++side) {
    const Index node = sides.node(side);
    if (node == kNone) continue;
    if (!used[node]) used[node] = 1, ++count;
    count -= sides.opposite(side) == kNone || side < sides.opposite(side);
  }
  return count;
}

Defect defect_at(const char* what, const Vector3d& p) { return {std::string(what) + " at " + describe(p), p}; }

/// Corner with the smallest sine, if that is too small; else N.
template <std::size_t N>
std::size_t bad_corner(const std::array<double, N>& sines) {
  const auto least = std::min_element(sines.begin(), sines.end());
  return *least > kLeastSine<N> ? N : std::size_t(least - sines.begin());
}

template <std::size_t N>
std::optional<Defect> look_at(const Result& result, Index element, const std::array<Index, N>& nodes, double beside) {
  const Corners<N> p = corners_of<N>(result.mesh().points, nodes);
  const std::size_t corner = bad_corner(result.sines(element, p, nodes));
  if (corner < N && !is_folded_under(result.surface(), result.normals(), p, result.triangle(element)))
    return defect_at("an element has a corner that is not convex", p[corner]);
  for (std::size_t i = 0; i < N; ++i) {
    const Index row = result.mesh().source[nodes[i]];
    if (row != kNone && result.surface().point(row) == p[i]) continue;
    const double length2 = (p[(i + 1) % N] - p[i]).squaredNorm();
    if (!(result.foot(element, nodes[i]).distance2 <= beside * beside * length2))
      return defect_at("a node has left the surface", p[i]);
  }
  return {};
}

/// Joined triangles of which one lies back over the other, or has no normal. Where a thin tube has few triangles around
/// they turn by a right angle and more, and elements that are not turned over can be found all the same.
bool are_folded(const Background& surface, Index t, Index other) {
  constexpr double kFold = -0.8;  // cosine between the normals: less than 37 degrees are left between the triangles
  const Vector3d &a = surface.normal(t), &b = surface.normal(other);
  return a.isZero() || b.isZero() || a.dot(b) < kFold;
}

}  // namespace

template <std::size_t N>
bool is_folded_under(const Background& surface, const SurfaceNormals& normals, const Corners<N>& p, Index hint) {
  Vector3d centre = Vector3d::Zero();
  for (const Vector3d& corner : p) centre += corner / double(N);
  std::set<Index> near;
  const auto add = [&](const Vector3d& point) {
    const Index t = normals.closest(point, hint).triangle;
    near.insert(t);
    for (int i = 0; i < 3; ++i)
      if (surface.neighbour(t, i) != kNone) near.insert(surface.neighbour(t, i));
  };
  add(centre);
  for (const Vector3d& corner : p) add(corner + 0.25 * (centre - corner));
  return std::any_of(near.begin(), near.end(), [&](Index t) {
    for (int i = 0; i < 3; ++i)
      if (const Index other = surface.neighbour(t, i); near.contains(other) && are_folded(surface, t, other))
        return true;
    return false;
  });
}

template bool is_folded_under(const Background&, const SurfaceNormals&, const Corners<3>&, Index);
template bool is_folded_under(const Background&, const SurfaceNormals&, const Corners<4>&, Index);

std::optional<Defect> find_defect(const Patch& before, const QuadMesh& after, std::size_t kept, double beside) {
  const Result result(before, after);
  const Index triangles = Index(after.triangles.size());
  for (Index t = 0; t < triangles; ++t)
    if (auto defect = look_at(result, t, after.triangles[t], beside)) return defect;
  for (Index q = Index(kept); q < after.quads.size(); ++q)
    if (auto defect = look_at(result, triangles + q, after.quads[q], beside)) return defect;
  if (characteristic(before.points.size(), before.triangles, before.quads) !=
      characteristic(after.points.size(), after.triangles, after.quads))
    return Defect{"a handle or a hole has come or gone", {}};
  return {};
}

Index find_bad_quad(const Patch& patch, Index& corner) {
  const ElementSides sides(patch.points.size(), patch.triangles, patch.quads, patch.constraints);
  const MeshNormals normals(patch.points, sides);
  for (Index q = 0; q < patch.quads.size(); ++q) {
    const std::size_t k = bad_corner(
        corner_sines(corners_of<4>(patch.points, patch.quads[q]), normals.of<4>(Index(patch.triangles.size()) + q)));
    if (k == 4) continue;
    corner = patch.quads[q][k];
    return q;
  }
  return kNone;
}

}  // namespace qmorph::space
