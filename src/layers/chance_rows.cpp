// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/chance_rows.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "layers/remnants.hpp"
#include "quality/percentile.hpp"

namespace qmorph::layers {
namespace {

/// Ragged sides for each cell: a block of four rows in the midst of thin triangles has as many.
constexpr double kRagged = 0.5;
/// The same of a block whose cells lean, and by how many of their heights the middle one leans.
constexpr double kRaggedIfLeaning = 0.2, kLeans = 0.2;
/// So many thin triangles that hang together are more than a gap in a layer, or the tip of a wedge.
constexpr std::size_t kMany = 30;

/// How far a row rises or falls over one cell, in heights of it, against what is perpendicular to the cell's lateral
/// sides.
double lean_of(const Sides& sides, const Cell& cell) {
  const auto middle = [&](Index c) {
    return Eigen::Vector3d((sides.point(sides.from(c)) + sides.point(sides.to(c))) / 2);
  };
  const Eigen::Vector3d along = middle(cell.right) - middle(cell.left), up = middle(cell.top) - middle(cell.base);
  const double area = along.cross(up).norm();
  return area > 0 ? std::abs(along.dot(up)) / area * cell.aspect() : 0;
}

/// Cells that hang together.
struct Block {
  std::vector<double> leans{};
  std::size_t ragged = 0;  ///< sides beyond which many thin triangles are no cells

  bool is_by_chance() {
    const double most = kRagged * double(leans.size());
    if (double(ragged) > most) return true;
    return double(ragged) > kRaggedIfLeaning * double(leans.size()) && percentile(leans, 50) > kLeans;
  }
};

}  // namespace

void drop_chance_rows(Cells& cells, const std::vector<Index>& thin) {
  const Sides& sides = cells.sides();
  const Parts parts = parts_of(sides, [&](Index t) { return cells.is_taken(t); });
  std::vector<Block> blocks(parts.sizes.size());
  const auto block_at = [&](Index triangle) -> Block& { return blocks[parts.part_of[triangle]]; };
  std::vector<char> is_free_and_thin(sides.count() / 3, 0);
  for (Index t : thin) is_free_and_thin[t] = !cells.is_taken(t);
  const Parts gaps = parts_of(sides, [&](Index t) { return is_free_and_thin[t] != 0; });
  for (Index t : thin) {
    if (cells.is_taken(t) || gaps.sizes[gaps.part_of[t]] < kMany) continue;
    for (Index c = 3 * t; c < 3 * t + 3; ++c)
      if (!sides.is_wall(c) && cells.is_taken(sides.opposite(c) / 3) && !sides.turns_sharply(c))
        ++block_at(sides.opposite(c) / 3).ragged;
  }
  for (Index i = 0; i < cells.size(); ++i)
    if (cells.is_live(i)) block_at(cells[i].triangles[0]).leans.push_back(lean_of(sides, cells[i]));
  std::vector<char> is_by_chance;
  for (Block& block : blocks) is_by_chance.push_back(block.is_by_chance());
  for (Index i = 0; i < cells.size(); ++i)
    if (cells.is_live(i) && is_by_chance[parts.part_of[cells[i].triangles[0]]]) cells.drop(i);
}

}  // namespace qmorph::layers
