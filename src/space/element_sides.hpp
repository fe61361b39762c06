// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/index.hpp"

namespace qmorph::space {

/// Triangles and quads with their neighbours. Triangles are numbered first; side 4 * element + i runs from corner i to
/// the next. Arrays that it is made of must outlive it. Cost: linear.
class QMORPH_API ElementSides {
 public:
  using Edge = std::array<Index, 2>;

  /// Neighbours are not joined across `barriers`, nor where more than two elements meet or they are not oriented alike.
  ElementSides(std::size_t nodes, std::span<const std::array<Index, 3>> triangles,
               std::span<const std::array<Index, 4>> quads, std::span<const Edge> barriers = {});

  Index elements() const { return Index(triangles_.size() + quads_.size()); }
  Index slots() const { return 4 * elements(); }
  bool is_triangle(Index element) const { return element < triangles_.size(); }
  Index degree(Index element) const { return is_triangle(element) ? 3 : 4; }
  /// Node that a side starts at; kNone for the fourth of a triangle.
  Index node(Index side) const {
    const Index e = side / 4, i = side % 4;
    if (!is_triangle(e)) return quads_[e - triangles_.size()][i];
    return i < 3 ? triangles_[e][i] : kNone;
  }
  Index next(Index side) const { return side % 4 + 1 == degree(side / 4) ? side - side % 4 : side + 1; }
  Index previous(Index side) const { return side % 4 == 0 ? side + degree(side / 4) - 1 : side - 1; }
  Index target(Index side) const { return node(next(side)); }
  Index opposite(Index side) const { return opposite_[side]; }

  /// Calls visit(side) for this side and all others that start at the same node in elements joined to its own around
  /// there.
  template <class Visit>
  void for_fan(Index side, const Visit& visit) const {
    visit(side);
    Index e = opposite_[side];
    for (; e != kNone; e = opposite_[e]) {
      e = next(e);
      if (e == side) return;
      visit(e);
    }
    for (e = side; (e = opposite_[previous(e)]) != kNone;) visit(e);
  }

 private:
  std::span<const std::array<Index, 3>> triangles_;
  std::span<const std::array<Index, 4>> quads_;
  std::vector<Index> opposite_;
};

}  // namespace qmorph::space
