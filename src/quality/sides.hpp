// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The sides of elements, those of one edge together.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/patch.hpp"

namespace qmorph {

/// One side of one element: from `low` to `high` if `forward`, else from `high` to `low`.
struct Side {
  Index low = 0, high = 0;
  Index element = 0;  ///< triangles first, then quads
  bool forward = true;
};

/// All sides in the order of (low, high, element). Linear for meshes: a bucket for each node, a few sides in each.
QMORPH_API std::vector<Side> sorted_sides(std::size_t points, std::span<const std::array<Index, 3>> triangles,
                                          std::span<const std::array<Index, 4>> quads);

/// Calls `visit(std::span<const Side>)` for each edge with the sides that lie on it. \pre they follow one another; of
/// any kind of side with `low` and `high`
template <class AnySide, class Visit>
void for_each_edge(const std::vector<AnySide>& sides, Visit&& visit) {
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last].low == sides[first].low && sides[last].high == sides[first].high) ++last;
    visit(std::span<const AnySide>(sides).subspan(first, last - first));
    first = last;
  }
}

}  // namespace qmorph
