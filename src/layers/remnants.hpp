// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What is left between layers: sets of free triangles, and how sets with an odd number of sides become even.

#include "layers/cells.hpp"

namespace qmorph::layers {

/// Triangles joined through edges that are no walls. Of all triangles, of the free ones, or of others.
struct Parts {
  std::vector<Index> part_of;      ///< by triangle; kNone if it is taken
  std::vector<std::size_t> sizes;  ///< triangles by part; as odd as the number of the part's sides
  bool is_odd(Index part) const { return sizes[part] % 2 != 0; }
};

/// Of those triangles for which is_in(triangle) holds.
template <class IsIn>
Parts parts_of(const Sides& sides, const IsIn& is_in) {
  Parts parts;
  parts.part_of.assign(sides.count() / 3, kNone);
  std::vector<Index> open;
  for (Index first = 0; first < parts.part_of.size(); ++first) {
    if (!is_in(first) || parts.part_of[first] != kNone) continue;
    const Index part = Index(parts.sizes.size());
    parts.sizes.push_back(0);
    parts.part_of[first] = part;
    open.push_back(first);
    while (!open.empty()) {
      const Index t = open.back();
      open.pop_back();
      ++parts.sizes[part];
      for (Index c = 3 * t; c < 3 * t + 3; ++c) {
        if (sides.is_wall(c)) continue;
        const Index other = sides.opposite(c) / 3;
        if (!is_in(other) || parts.part_of[other] != kNone) continue;
        parts.part_of[other] = part;
        open.push_back(other);
      }
    }
  }
  return parts;
}

Parts all_parts(const Sides& sides);
Parts free_parts(const Cells& cells);

/// One row between two walls is a row as a whole, or none: where the nodes of the two are not opposite each other,
/// pairs that happen to look like cells would be in the way of the others.
void drop_broken_rows(Cells& cells, const Parts& regions);

/// A column of cells between two free triangles that is cut in two from end to end: each edge that it crosses gets a
/// node in its middle.
struct Cut {
  std::vector<Index> cells;
  Index start = kNone, end = kNone;  ///< sides of the free triangles
};

/// Makes all parts of a region even, but for one if the region is odd. A column between two parts, cut in two, makes an
/// odd one even and leaves every row as it is; where there is none, cells are dropped so that parts become one.
/// \param regions all_parts(cells.sides())
/// Cost: in proportion to the triangles, times the logarithm of how many parts are odd.
std::vector<Cut> make_even(Cells& cells, const Parts& regions);

}  // namespace qmorph::layers
