// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/cells.hpp"

namespace qmorph::layers {

Index Cells::take(const Cell& cell) {
  for (Index t : cell.triangles) owner_[t] = Index(cells_.size());
  cells_.push_back(cell);
  return Index(cells_.size() - 1);
}

void Cells::drop(Index i) {
  for (Index t : cells_[i].triangles) owner_[t] = kNone;
}

Index Cells::beside(Index c) const {
  if (sides_.is_wall(c)) return kNone;
  const Index other = sides_.opposite(c), cell = owner_[other / 3];
  return cell != kNone && (cells_[cell].left == other || cells_[cell].right == other) ? cell : kNone;
}

bool Cells::has_neighbour_in_pile(const Cell& cell) const {
  const auto goes_on = [&](Index side) {
    return !sides_.is_wall(side) && is_taken(sides_.opposite(side) / 3) && !sides_.turns_sharply(side);
  };
  return goes_on(cell.base) || goes_on(cell.top);
}

std::size_t Cells::row_length(Index i, Index first, std::size_t most) const {
  std::size_t length = 1, walls = 0;
  for (Index side : {cells_[i].left, cells_[i].right})
    while (true) {
      if (sides_.is_wall(side) && ++walls) break;
      const Index other = sides_.opposite(side), at = beside(side);
      if (at == kNone && sides_.turns_sharply(side) && has_neighbour_in_pile(cells_[i]) && ++walls) break;
      if (at == kNone || at < first) break;
      if (at == i || ++length >= most) return most;
      side = other == cells_[at].left ? cells_[at].right : cells_[at].left;
    }
  return walls == 2 ? most : length;
}

}  // namespace qmorph::layers
