// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "gmsh/geometry/landing.hpp"

namespace qmorph::adapter {

/// The elements of a surface of second or higher order, which describe its shape better than the triangles between
/// their corners.
class CurvedTriangles {
 public:
  /// Nothing for a surface whose elements are flat: curved sides in their plane do not change where they are.
  static std::unique_ptr<CurvedTriangles> find(const ModelMesh& mesh, std::uint32_t entity);

  /// Each point goes to the closest one of the curved element that it is in the flat triangle of.
  std::vector<Landing> land(std::span<const OnInput> points) const;

 private:
  struct Place {
    std::size_t block = 0, element = 0;
    std::array<std::size_t, 3> corners{};  ///< of the element, by ascending row
  };
  /// A point of those to land, and the element of a block that it lands on.
  struct Asked {
    std::size_t point = 0, element = 0;
  };
  CurvedTriangles(const ModelMesh& mesh, const EntityMesh& surface);
  bool are_flat() const;
  /// `functions`: of the element's type, by node. `b`: the block.
  Eigen::Vector3d at(std::size_t b, std::size_t element, const double* functions) const;
  /// Moves `local`, a point of the reference element for each that is asked for.
  void come_nearest(std::size_t b, std::span<const OnInput> points, const std::vector<Asked>& asked,
                    std::vector<Eigen::Vector2d>& local) const;
  Eigen::Vector3d node(const ElementBlock& block, std::size_t element, std::size_t i) const {
    return mesh_.points[mesh_.rows.find(block.nodes[element * block.nodes_per_element + i])];
  }

  const ModelMesh& mesh_;
  const EntityMesh& surface_;
  std::vector<ElementType> types_;                ///< of the blocks
  std::map<std::array<Index, 3>, Place> places_;  ///< by rows of three corners, ascending
};

}  // namespace qmorph::adapter
