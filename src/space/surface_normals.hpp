// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <span>
#include <vector>

#include "space/background.hpp"
#include "space/corners.hpp"
#include "space/element_sides.hpp"

namespace qmorph::space {

/// Where an element is judged by the surface, from a triangle `hint` nearby: its corners by the triangles that are closest to points
/// a quarter of the way to its centre, so that a corner on a crease is judged by its own side.
template <std::size_t N>
CornerNormals<N> normals_on(const Background& surface, const Corners<N>& p, Index hint);

/// Scaled Jacobian by these normals.
template <std::size_t N>
double scaled_jacobian_on(const Background& surface, const Corners<N>& p, Index hint) {
  return scaled_jacobian(p, normals_on(surface, p, hint));
}

/// Elements on a surface, of which nothing is known but which nodes come from the input: `source` is the row of the surface's points
/// of each node, or kNone. Empty: none does.
struct ElementsOnSurface {
  const Background& surface;
  std::span<const Eigen::Vector3d> points;
  std::span<const std::array<Index, 3>> triangles;
  std::span<const std::array<Index, 4>> quads;
  std::span<const Index> source;
};

/// The triangle of the surface that is closest to each element's centre, on the right side of barriers: from a side of the element that
/// is one of the surface, or else by a walk from a neighbour. `sides` are the elements', with the same barriers. Elements that
/// are joined to no such side are looked for everywhere.
/// Cost: linear, but for those: n log n.
std::vector<Index> locate(const ElementsOnSurface& mesh, const ElementSides& sides);

}  // namespace qmorph::space
