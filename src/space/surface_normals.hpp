// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "qmorph/export.hpp"
#include "space/background.hpp"
#include "space/corners.hpp"
#include "space/element_sides.hpp"
#include "space/triangle_tree.hpp"

namespace qmorph::space {

/// The normals of a surface by which elements on it are judged: at a corner that of the triangle closest to the point a
/// quarter of the way to the element's centre, so that a corner on a crease is judged by its own side.
class QMORPH_API SurfaceNormals {
 public:
  /// The surface must outlive this. Cost: linear where it is smooth, else n log n.
  explicit SurfaceNormals(const Background& surface);

  /// `hint` is a triangle nearby, on the same side of the barriers.
  template <std::size_t N>
  CornerNormals<N> of(const Corners<N>& p, Index hint) const;

  /// The closest point of all on this side of the barriers, also where walks end in folds.
  Foot closest(const Eigen::Vector3d& p, Index hint) const;

 private:
  const Background& surface_;
  std::vector<Index> part_;           ///< of each triangle: parts are joined across sides that are no barriers
  std::optional<TriangleTree> tree_;  ///< only for a surface that is not smooth
};

/// Elements on a surface, of which nothing is known but which nodes come from the input: `source` is the row of the
/// surface's points of each node, or kNone. Empty: none does.
struct ElementsOnSurface {
  const Background& surface;
  std::span<const Eigen::Vector3d> points;
  std::span<const std::array<Index, 3>> triangles;
  std::span<const std::array<Index, 4>> quads;
  std::span<const Index> source;
};

/// The triangle of the surface that is closest to each element's centre, on the right side of barriers: from a side of
/// the element that is one of the surface, or else near a neighbour's. `sides` are the elements', with the same
/// barriers; `normals` are the surface's. Elements that are joined to no such side are looked for everywhere.
/// Cost: linear, but for those and where the surface is not smooth: n log n.
std::vector<Index> locate(const ElementsOnSurface& mesh, const ElementSides& sides, const SurfaceNormals& normals);

}  // namespace qmorph::space
