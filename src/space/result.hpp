// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/patch.hpp"
#include "space/corners.hpp"
#include "space/element_sides.hpp"
#include "space/reference.hpp"
#include "space/surface_normals.hpp"

namespace qmorph::space {

/// Constraints of a patch by the rows of what it was made into.
std::vector<std::array<Index, 2>> kept_constraints(const Patch& before, const QuadMesh& after);

/// What a surface was made into, and where on the surface its elements and nodes are. Both must outlive this. Cost:
/// linear.
class QMORPH_API Result {
 public:
  Result(const Patch& before, const QuadMesh& after);

  const QuadMesh& mesh() const { return after_; }
  const ElementSides& sides() const { return sides_; }
  const Background& surface() const { return reference_.surface; }
  const SurfaceNormals& normals() const { return normals_; }
  /// Rows of the patch's triangles come first in the surface.
  Index triangle(Index element) const { return triangle_[element]; }
  /// Of a node that lies inside: the closest point of the surface. At the boundary and at constraints there may be
  /// several, and `triangle` is kNone.
  const Foot& foot(Index node) const { return foot_[node]; }
  /// The closest point for a corner of an element.
  Foot foot(Index element, Index node) const;

  /// By the surface's normals at the nodes if those leave no doubt, else by looking closer; signed as corner_sines()
  /// does.
  template <std::size_t N>
  std::array<double, N> sines(Index element, const Corners<N>& p, const std::array<Index, N>& nodes) const;

 private:
  template <std::size_t N>
  bool is_smooth_at(Index element, const std::array<Index, N>& nodes) const;
  template <std::size_t N>
  CornerNormals<N> normals_at_nodes(Index element, const std::array<Index, N>& nodes) const;

  const QuadMesh& after_;
  Reference reference_;
  SurfaceNormals normals_;
  ElementSides sides_;
  std::vector<Index> triangle_;  ///< by element
  std::vector<Foot> foot_;       ///< by node
  std::vector<Eigen::Vector3d> normal_;
};

}  // namespace qmorph::space
