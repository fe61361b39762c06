// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <span>
#include <vector>

#include "space/corners.hpp"
#include "space/element_sides.hpp"

namespace qmorph::space {

/// Normals of a surface of which there is nothing but its own triangles and quads: an element is judged by those around
/// it, so that one that is turned over among others is seen, whatever way it turns itself.
class MeshNormals {
 public:
  MeshNormals(std::span<const Eigen::Vector3d> points, const ElementSides& sides);

  /// At its corners by the elements that meet there, as a whole by its neighbours and, with the weight of two, by
  /// itself.
  template <std::size_t N>
  CornerNormals<N> of(Index element) const;
  /// Unit normal of the element itself; zero if it has none.
  const Eigen::Vector3d& own(Index element) const { return of_element_[element]; }

 private:
  const ElementSides& sides_;
  std::vector<Eigen::Vector3d> of_element_;  ///< unit normals
  std::vector<Index> fan_;                   ///< by side, of the node that it starts at
  std::vector<Eigen::Vector3d> of_fan_;
};

}  // namespace qmorph::space
