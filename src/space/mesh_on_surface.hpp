// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A mesh on the triangles of a surface whose nodes move: what smoothing and repair in space look at.

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "chart/surface_mesh.hpp"
#include "smoothing/node_energy.hpp"
#include "space/background.hpp"
#include "space/corners.hpp"
#include "space/whole_surface.hpp"

namespace qmorph::space {

/// The elements around a node, each turned about the node into the tangent plane there: lengths and angles are those in
/// space; only the bend of an element is lost. The node is at the origin.
struct UnfoldedStar {
  std::vector<smoothing::StarElement> elements;
  Eigen::Vector3d axis_u, axis_v;
  double edge = 0;  ///< mean length of the edges at the node

  Eigen::Vector3d in_space(const Vec2& p) const { return p.x() * axis_u + p.y() * axis_v; }
};

class MeshOnSurface {
 public:
  using Mesh = chart::SurfaceMesh;
  using Face = chart::Face;

  /// `creases` are edges of the mesh, lower node first, sorted: the mesh parts there, as the surface does, and their
  /// nodes stay. Mesh::near is brought to the right side of them. `whole` has no creases, since those who judge a
  /// result later do not know of them. `stretched`, by triangle, is where shapes are not to be squares; may be empty.
  MeshOnSurface(Mesh& mesh, const std::vector<std::pair<Index, Index>>& creases, const Background& surface,
                WholeSurface whole, std::span<const char> stretched = {});

  const Mesh& mesh() const { return mesh_; }
  const Background& surface() const { return surface_; }
  Index nodes() const { return Index(mesh_.points.size()); }
  Index faces() const { return Index(mesh_.faces.size()); }
  /// May move: not fixed, and inside.
  bool is_free(Index v) const { return is_free_[v]; }
  /// And may be smoothed.
  bool is_to_be_smoothed(Index v) const { return is_free_[v] && (stretched_.empty() || !stretched_[mesh_.on[v]]); }
  const Eigen::Vector3d& point(Index v) const { return mesh_.points[v]; }
  /// Unit normal of the surface there.
  const Eigen::Vector3d& normal(Index v) const { return normal_[v]; }

  /// Calls visit(side) for the sides that start at a node, counter-clockwise; none if no face uses it.
  template <class Visit>
  void for_sides_around(Index v, const Visit& visit) const {
    const Index start = first_side_[v];
    if (start == kNone) return;
    Index side = start;
    do {
      visit(side);
      side = opposite_[previous(side)];
    } while (side != kNone && side != start);
  }
  Index next(Index side) const { return side - side % 4 + chart::next_corner(mesh_.faces[side / 4], side % 4); }
  Index previous(Index side) const { return side % 4 ? side - 1 : side + chart::degree(mesh_.faces[side / 4]) - 1; }
  Index node(Index side) const { return mesh_.faces[side / 4][side % 4]; }
  Index opposite(Index side) const { return opposite_[side]; }

  /// Smallest corner sine of a face, signed by the surface's normals at its nodes: nearly exact_sine(), and cheap.
  double smallest_sine(Index face) const;
  /// All corners have larger sines than this, and turn so clearly the way the surface does at the nodes that looking
  /// closer is not needed.
  bool is_clearly_above(Index face, double sine) const;
  /// exact_sine(), by smallest_sine() where looking closer is not needed.
  double sure_sine(Index face) const;
  /// Of the faces around a node.
  double smallest_sine_around(Index v) const;
  /// The one that counts, by the surface's normals near the corners.
  double exact_sine(Index face) const;
  /// By the face's own normal: a solver judges an element by itself.
  double own_sine(Index face) const { return chart::own_sine(mesh_, mesh_.faces[face]); }
  /// How often exact_sine() had to look, which costs much more than anything else here.
  std::size_t exact_looks() const { return exact_looks_; }
  /// smallest_rise() by the same normals.
  double exact_rise(Index face) const;

  /// False if an element there is turned so far against the tangent plane that it cannot be laid into it.
  bool unfold(Index v, UnfoldedStar& star) const;

  /// A point of the surface near one of a node's tangent plane.
  Foot foot(Index v, const Eigen::Vector3d& p) const { return surface_.walk(p, mesh_.on[v]); }
  void move(Index v, const Foot& foot);
  /// Where a node is, to bring it back there.
  struct Place {
    Eigen::Vector3d point, normal;
    Index triangle;
  };
  Place place(Index v) const { return {mesh_.points[v], normal_[v], mesh_.on[v]}; }
  void move(Index v, const Place& place) {
    mesh_.points[v] = place.point, normal_[v] = place.normal, mesh_.on[v] = place.triangle;
    forget_exact(v);
  }

 private:
  void cut(const std::vector<std::pair<Index, Index>>& creases);
  /// smallest_sine(), if looking closer is not needed.
  std::optional<double> clear_sine(Index face) const;
  double look_closely(Index face) const;
  /// Of the faces around a node that moves.
  void forget_exact(Index v) {
    if (!exact_.empty()) for_sides_around(v, [&](Index side) { exact_[side / 4] = kUnknown; });
  }
  void find_places();
  Eigen::Vector3d centre(Index face) const;
  Eigen::Vector3d normal_of(Index face) const;
  template <std::size_t N>
  Corners<N> corners(const Face& face) const;
  template <std::size_t N>
  CornerNormals<N> normals(Index face) const;

  Mesh& mesh_;
  const Background& surface_;
  const WholeSurface whole_;
  const std::span<const char> stretched_;
  std::vector<Index> opposite_;    ///< by side
  std::vector<Index> first_side_;  ///< by node: the one that has nothing before it, if there is a gap
  std::vector<char> is_free_;
  std::vector<char> is_on_crease_;  ///< by node
  std::vector<Eigen::Vector3d> normal_;
  static constexpr double kUnknown = 2;  ///< no sine
  mutable std::vector<double> exact_;    ///< exact_sine() by face, once it is asked for: most faces are asked for often
  mutable std::size_t exact_looks_ = 0;
};

}  // namespace qmorph::space
