// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The cells that are taken so far.

#include <vector>

#include "layers/cell.hpp"

namespace qmorph::layers {

class Cells {
 public:
  explicit Cells(const Sides& sides) : sides_(sides), owner_(sides.count() / 3, kNone) {}

  const Sides& sides() const { return sides_; }
  std::size_t size() const { return cells_.size(); }
  const Cell& operator[](Index i) const { return cells_[i]; }
  bool is_live(Index i) const { return owner_[cells_[i].triangles[0]] == i; }
  /// The cell that has the triangle, or kNone.
  Index owner(Index triangle) const { return owner_[triangle]; }
  bool is_taken(Index triangle) const { return owner_[triangle] != kNone; }

  /// Both triangles must be free.
  Index take(const Cell& cell);
  void drop(Index i);

  /// The cell beyond side c, if it has that edge for one of its lateral sides; else kNone.
  Index beside(Index c) const;
  bool has_neighbour(const Cell& cell) const { return beside(cell.left) != kNone || beside(cell.right) != kNone; }
  /// Whether there is a cell below or above, on the same face of the model.
  bool has_neighbour_in_pile(const Cell& cell) const;
  /// How many cells share lateral sides in a row with this one: all of them if the row is closed or ends at walls, and
  /// then `most`. No more than that are counted, and none that was taken before the cell `first`. In a pile, sharp
  /// edges are walls: a row of one cell may go from rim to rim.
  std::size_t row_length(Index i, Index first, std::size_t most) const;

 private:
  const Sides& sides_;
  std::vector<Cell> cells_;
  std::vector<Index> owner_;  ///< by triangle
};

}  // namespace qmorph::layers
