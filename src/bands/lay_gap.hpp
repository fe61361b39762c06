// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One gap of a net as rows of quads.

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "bands/gap_net.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::bands {

/// Which ends of a gap have two rows.
using Doubled = std::array<bool, 2>;

struct GapLayout {
  std::optional<kernel::Mesh> rows;           ///< none for a gap without triangles
  std::vector<Index> nodes;                   ///< of the region: the first ones of `rows`
  std::array<Index, 2> middle{kNone, kNone};  ///< places among them of those between two rows at the ends
  /// The node between two rows is a new one inside the gap, in the corner of a quad with the junction's three: a kite.
  /// Its number in `nodes` is none of the region's.
  std::array<bool, 2> has_kite{false, false};
  double cost = std::numeric_limits<double>::infinity();  ///< in quads of sine 0
  std::size_t work = 0;
};

/// Best of the ways to lay a gap's rows; without a cost if there is none. `points`: the region's.
GapLayout lay_gap(const Gap& gap, const Doubled& doubled, const std::vector<Vec2>& points);

/// Two triangles share a side there.
bool is_empty(const Gap& gap);

/// Of a junction and its side towards a gap: the side's nodes in its own sense, the gap on their right.
std::array<Index, 2> side_of(const Gap& gap, int end);

/// Where a kite's node is at first: as far into the gap as half its width, or half-way to the next nodes.
Vec2 kite_point(const Gap& gap, int end, const std::vector<Vec2>& points);

}  // namespace qmorph::bands
