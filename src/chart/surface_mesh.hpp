// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A mesh on a region of a surface in space, and pieces of it that can be laid flat and worked on in the plane.

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "engine/regions.hpp"
#include "kernel/mesh.hpp"
#include "space/background.hpp"

namespace qmorph::chart {

/// Triangles (the last corner is kNone) and quads; sides are numbered 4 * face + i.
using Face = std::array<Index, 4>;
inline Index degree(const Face& face) { return face[3] == kNone ? 3 : 4; }
inline Index next_corner(const Face& face, Index i) { return i + 1 == degree(face) ? 0 : i + 1; }

/// Nodes of the input have smaller numbers than new ones.
inline constexpr Index kFirstNew = kNone / 2;

/// A manifold of faces whose nodes lie on the triangles of a background.
struct SurfaceMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Index> on;    ///< triangle of the background, of each point
  std::vector<char> fixed;  ///< by point; those of the boundary need not be marked
  std::vector<Index> node;  ///< by point: those on both sides of a line have the same
  std::vector<Face> faces;
  std::vector<bool> open;   ///< sides that are boundary
  std::vector<Index> near;  ///< triangle of the background on or beside each face

  Index add_point(const Eigen::Vector3d& p, Index triangle) {
    points.push_back(p);
    on.push_back(triangle);
    fixed.push_back(0);
    node.push_back(kFirstNew + Index(points.size() - 1));
    return Index(points.size() - 1);
  }
};

/// Smallest sine of a face's corners, signed by the face's own normal: what bends a quad makes it worse.
double own_sine(const SurfaceMesh& mesh, const Face& face);
/// Of the worst face.
double smallest_own_sine(const SurfaceMesh& mesh);

/// By side: the same edge's side in the other face; kNone on the boundary.
std::vector<Index> opposite_sides(const SurfaceMesh& mesh);

/// Some faces of a mesh, as a surface with nodes of its own: one for each fan of its faces at a node of the mesh.
struct Piece {
  std::vector<Eigen::Vector3d> points;
  std::vector<Index> vertex;  ///< of the mesh, of each point
  std::vector<Index> on, node;
  std::vector<char> fixed;
  std::vector<Face> faces;
  std::vector<Index> near;
  std::vector<Index> row;  ///< of the mesh's faces
  std::vector<bool> open;  ///< sides where the piece ends
  std::vector<std::pair<Index, Index>>
      seams;  ///< open sides that are not the mesh's boundary: its vertices, lower first; sorted
  std::size_t boundary_sides = 0;
  /// Faces as triangles: of face f those from first_half[f] on, one or two.
  std::vector<std::array<Index, 3>> halves;
  std::vector<Index> first_half;

  /// `is_cut` by side of the mesh; may be empty. `opposite` as opposite_sides(mesh).
  Piece(const SurfaceMesh& mesh, const std::vector<Index>& opposite, const std::vector<bool>& is_cut,
        const std::vector<Index>& rows);
  /// Edges that the halves must not be joined across.
  std::vector<space::Background::Edge> barriers() const;
  /// As what the planar engine takes; its triangles are missing if there are quads.
  Region region(const std::vector<Vec2>& flat) const;
  kernel::Mesh mesh(const std::vector<Vec2>& flat) const;
};

}  // namespace qmorph::chart
