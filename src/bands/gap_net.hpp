// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Regions that are nets of gaps: mortar between bricks, boundaries between grains, clearances between parts, where
/// triangles have hardly a node inside.

#include <array>
#include <optional>
#include <vector>

#include "engine/regions.hpp"

namespace qmorph::bands {

/// Where a gap ends: at the side from `lower` to `upper` of a triangle with the third corner `beyond`.
struct GapEnd {
  Index junction = kNone;  ///< where three gaps meet; none at a dead end, which has the triangle's sides
  Index lower = kNone, upper = kNone, beyond = kNone;
};

/// Triangles in a row, from side to side.
struct Gap {
  std::vector<Index> lower, upper;  ///< nodes of the two sides, from the first end to the last
  std::array<GapEnd, 2> ends;
};

struct GapNet {
  std::vector<Gap> gaps;
  std::size_t junctions = 0;  ///< triangles without a side on the boundary
};

/// Of the triangles between the nodes of the boundary. Nothing if many nodes are inside, or one that is fixed, the
/// boundary touches itself, or there is no junction. Cost: linear.
std::optional<GapNet> find_gaps(const Region& region);

}  // namespace qmorph::bands
