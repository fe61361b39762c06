// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A surface, laid into its plane and cut along its constraints.

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/describe.hpp"
#include "geometry/vec2.hpp"
#include "qmorph/error.hpp"
#include "qmorph/patch.hpp"

namespace qmorph {

/// The plane of a surface: u runs along `axis_u`, v along `axis_v`, their cross product is the normal that the elements
/// follow.
struct Plane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_u = Eigen::Vector3d::UnitX(), axis_v = Eigen::Vector3d::UnitY();
  Eigen::Vector3d normal() const { return axis_u.cross(axis_v); }
  Vec2 to_plane(const Eigen::Vector3d& p) const { return {(p - origin).dot(axis_u), (p - origin).dot(axis_v)}; }
  /// Set where the plane is a chart of a curved surface: the point of the surface that a point of the chart stands for.
  std::function<Eigen::Vector3d(const Vec2&)> curved = {};
  Eigen::Vector3d to_space(const Vec2& p) const { return curved ? curved(p) : on_plane(p); }
  Eigen::Vector3d on_plane(const Vec2& p) const { return origin + p.x() * axis_u + p.y() * axis_v; }
};

/// For errors about a node of a patch.
inline ErrorSubject node_row(std::size_t row) { return {ErrorSubject::Kind::node, row}; }

/// Plane of the patch, which is sound (overlap.hpp), if it is planar. Throws SurfaceError if no triangle has an area.
std::optional<Plane> find_plane(const Patch& patch);

/// Triangles that are joined through edges that are no constraints, as a manifold with boundary: a node at which
/// several fans of triangles meet (a slit, a pinched boundary) becomes one vertex for each fan, so that
/// constraints need no care afterwards. They are boundary, and boundary never moves; a fan that goes all round its node
/// has it among `fixed`, or what touches it there would be left behind.
struct Region {
  std::vector<Vec2> points;
  std::vector<Index> node;  ///< row of Patch::points of each vertex
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> row;    ///< of Patch::triangles, of each triangle
  std::vector<bool> open;    ///< side 3 * triangle + i is boundary
  std::vector<Index> fixed;  ///< vertices to keep in place that may be inside
  std::size_t boundary_sides = 0;
};

/// Edges of the boundary, each from the node that it leads away from while the region is on its left.
std::vector<std::array<Index, 2>> boundary_edges(const Region& region);

/// What is done where more than two triangles meet at an edge: in a plane they overlap, in space they are sheets, and
/// parted there.
enum class EdgesOfMany { refuse, part };

/// The regions' triangles are in the patch's order, their vertices as these come upon them: what lies close together
/// does so in memory if it did in the patch (canonical/numbered.hpp).
/// Throws SurfaceError if an edge has two triangles on one side (overlap, inconsistent orientation).
std::vector<Region> cut_into_regions(const Patch& patch, const std::vector<Vec2>& plane_points,
                                     EdgesOfMany many = EdgesOfMany::refuse);

}  // namespace qmorph
