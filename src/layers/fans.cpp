// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/walls.hpp"

namespace qmorph::layers {
namespace {

/// What lies between two columns at a node: columns that grow from the triangles at the tip, from right to left. They
/// have no first row, since the triangles are there.
struct Fan {
  const Column *right = nullptr, *left = nullptr;  ///< on the walls
  std::vector<Column> columns;
};

/// Column `right` stands on the wall that begins at the node, column `left` on the one that ends there.
Fan fan_between(const Cells& cells, const Column& right, const Column& left) {
  const Sides& sides = cells.sides();
  Fan fan{&right, &left, {}};
  const Index last = cells[left.cells[0]].right;  // from the node
  // Spokes from the node, each seen from the triangle to its left.
  for (Index spoke = sides.opposite(cells[right.cells[0]].left); spoke != kNone && spoke != last;) {
    const Index outer = Sides::next(spoke);
    if (cells.is_taken(spoke / 3) || sides.is_wall(outer)) return {};
    fan.columns.push_back(column_from_tip(sides, outer));
    spoke = sides.opposite(Sides::next(outer));
    if (spoke == kNone) return {};
  }
  return fan;
}

/// True if nothing is beside that side, or that cell.
bool fits(const Cells& cells, Index side, const Column& column, std::size_t row) {
  return row >= column.cells.size() || cells.beside(side) == column.cells[row];
}

/// A whole row of the fan, or nothing. `row` counts from the wall, where the tip is row 0.
bool take_row(Cells& cells, Fan& fan, std::size_t row) {
  const Sides& sides = cells.sides();
  std::vector<Cell> found;
  for (const Column& column : fan.columns) {
    const auto cell = best_cell(cells, column);
    if (!cell || misfit(sides, *cell, column) > kMisfitBeside) return false;
    if (!found.empty() && sides.opposite(cell->right) != found.back().left) return false;
    found.push_back(*cell);
  }
  if (!fits(cells, found.front().right, *fan.right, row) || !fits(cells, found.back().left, *fan.left, row))
    return false;
  for (std::size_t i = 0; i < found.size(); ++i) grow(sides, fan.columns[i], cells.take(found[i]), found[i]);
  return true;
}

}  // namespace

void take_fans(Cells& cells, const std::vector<Column>& columns) {
  const Sides& sides = cells.sides();
  std::vector<Index> on_wall(sides.count(), kNone);
  for (Index i = 0; i < columns.size(); ++i) on_wall[cells[columns[i].cells[0]].base] = i;
  for (const Column& right : columns) {
    const Index before = on_wall[sides.previous_wall(cells[right.cells[0]].base)];
    if (before == kNone) continue;
    const Column& left = columns[before];
    Fan fan = fan_between(cells, right, left);
    if (fan.columns.empty()) continue;
    const std::size_t rows = std::max(right.cells.size(), left.cells.size());
    for (std::size_t row = 1; row < rows && take_row(cells, fan, row);) ++row;
  }
}

}  // namespace qmorph::layers
