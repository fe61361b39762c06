// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Connected parts of a surface and the one orientation that each of them has.

#include <array>
#include <cstddef>
#include <vector>

#include "quality/sides.hpp"

namespace qmorph::adapter {

/// The elements of a surface, seen as a graph over edges.
struct Orientation {
  std::vector<Index> part;  ///< of each element; parts are numbered in the order of their first element
  std::vector<bool> flip;   ///< elements to turn, always the smaller share of their part
  Index parts = 0;
  std::size_t flipped = 0;
  /// Edges where more than two elements meet, lower node first: the sheets that meet there do not hang together by
  /// them.
  std::vector<std::array<Index, 2>> of_many;
  /// Set if something is wrong, and then nothing else counts: an edge where no turning helps (a Moebius strip).
  const char* defect = nullptr;
  Side where;
};

/// \param elements how many elements the sides belong to
Orientation orient(std::size_t elements, const std::vector<Side>& sides);

/// The same for what need not have an orientation: edges with more than two elements join nothing, and where no turning
/// helps something is left as it is. No defect is set.
Orientation orient_where_possible(std::size_t elements, const std::vector<Side>& sides);

}  // namespace qmorph::adapter
