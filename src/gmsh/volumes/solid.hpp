// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The elements of one volume as arrays: what is turned over among them, and what does not fit.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// Linear elements, by Gmsh's numbers for their types.
enum class CellShape { tetrahedron = 4, hexahedron = 5, prism = 6, pyramid = 7 };
inline constexpr std::array kCellShapes = {CellShape::tetrahedron, CellShape::hexahedron, CellShape::prism,
                                           CellShape::pyramid};

/// A corner of a cell and the three nodes that it is joined with, in the order in which they span a positive volume. Of
/// a tetrahedron one corner says all; a pyramid has those of its base.
using CellCorner = std::array<Index, 4>;
std::span<const CellCorner> corners_of(CellShape shape);
std::size_t nodes_of(CellShape shape);

struct Cell {
  CellShape shape = CellShape::tetrahedron;
  std::array<Index, 8> nodes{};  ///< in Gmsh's order
};

struct Solid {
  std::vector<Index> rows;  ///< of the model's mesh, by node
  std::vector<Eigen::Vector3d> points;
  std::vector<bool> may_move;   ///< a node inside
  std::vector<Cell> cells;      ///< by shape, then as the model has them
  std::size_t loose_faces = 0;  ///< neither between two cells nor on the volume's surfaces
  Eigen::Vector3d loose_at = Eigen::Vector3d::Zero();
};

/// Reads a volume of order 1. Gmsh turns the numbering of an element that is turned over, so that its own volume is
/// positive: cells are in the order that their neighbours ask for, and one that is turned over has a negative volume.
Solid read_solid(const ModelMesh& mesh, const EntityMesh& volume);

/// Six times the volume at a corner.
double spanned_volume(const Solid& solid, const Cell& cell, const CellCorner& corner);

/// Numbers of cells that are turned over or flat at a corner.
std::vector<std::size_t> find_turned(const Solid& solid);

/// The volume that a solid was read from, with the solid's places of nodes and order of the nodes in elements.
EntityMesh with_solid(const ModelMesh& mesh, EntityMesh volume, const Solid& solid);

}  // namespace qmorph::adapter
