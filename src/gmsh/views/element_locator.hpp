// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Which element of a surface a point lies in.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// A place in an element.
struct ElementPlace {
  const ElementBlock* block = nullptr;
  std::size_t element = 0;             ///< of the block
  std::array<std::size_t, 3> corners;  ///< of the element: those of the triangle, or of the half of the quad
  Eigen::Vector3d weights;             ///< of the corners, linear; they sum up to 1
};

/// Triangles, and quads cut in two, of one surface, in a grid of cubes.
class ElementLocator {
 public:
  /// \pre `mesh` and `surface` live longer than the locator
  ElementLocator(const ModelMesh& mesh, const EntityMesh& surface);
  bool empty() const { return pieces_.empty(); }
  /// The element that a point is in, or the nearest one. Cost: that of a few elements, for points near the surface.
  ElementPlace find(const Eigen::Vector3d& point) const { return find(point, point); }
  /// Of the elements that a point is in, or on the border of, the one towards `inside`.
  ElementPlace find(const Eigen::Vector3d& point, const Eigen::Vector3d& inside) const;

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Piece {
    ElementPlace place;
    std::array<Eigen::Vector3d, 3> points;
  };
  struct Nearest;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };

  void add(const ModelMesh& mesh, const ElementBlock& block, std::size_t element, std::array<std::size_t, 3> corners);
  void make_grid();
  Cell cell_of(const Eigen::Vector3d& point) const;
  void look_into(const Cell& cell, Nearest& nearest) const;

  std::vector<Piece> pieces_;
  Eigen::Vector3d low_;
  double step_ = 1;  ///< the side of a cube
  std::unordered_map<Cell, std::vector<Index>, CellHash> cells_;
};

}  // namespace qmorph::adapter
