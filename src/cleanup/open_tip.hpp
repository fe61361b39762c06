// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Sharp corners of a boundary, where a row of quads ends that has a node more on one side than on the other.

#include <vector>

#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cleanup {

/// A row of quads from a side of the boundary on, as half-edges, each an opposite side of the one before: of the quad
/// at the tip, and so on. All run the same way.
///
///     tip = b0 ---- b1 ---- b2 -- ...        The quad (b0, a1, a2, b1) has a straight corner at a1, and can have none
///          \       /       /                 that is not as long as two sides of the boundary are straight.
///           a1 - a2 ---- a3 --- ...
struct TipRow {
  std::vector<Index> rungs;  ///< b0-a1, b1-a2, ...; the last is the far side of the last quad
  bool tip_first = true;     ///< whether the tip is the origin of the first rung, or its target
};

/// The row whose first quad is `face`, with a corner at the boundary's node `straight` that no other quad shares, and
/// the tip before or after it. At most `most` quads; nothing if there are fewer than two.
TipRow find_tip_row(const kernel::Mesh& mesh, Index face, Index straight, bool tip_first, std::size_t most);

/// With how many of its quads the row had best be opened: the fewest that leave room for the quad that closes it.
std::size_t quads_to_open(const kernel::Mesh& mesh, const TipRow& row);

/// Puts a line of nodes along the middle of the row's first quads, two or more: a kite at the tip, two quads for each
/// of the others, and in the last one a quad more, that closes them. So each node of the one side faces the one of the
/// other side that is as far from the tip. Topology, and places to begin with; appends the nodes around to `nodes`.
/// False, perhaps half-way, if it is impossible: to be called in a transaction.
bool open_tip(kernel::Mesh& mesh, const TipRow& row, std::size_t quads, std::vector<Index>& nodes);

/// Opens tips where a poor quad fills a sharp corner of the boundary and is straight at the next node of it, if that
/// raises the smallest sine around clearly. For boundaries that stay: not for interfaces. Returns how many.
std::size_t open_tips(kernel::Mesh& mesh, const SmoothingOptions& smoothing);

}  // namespace qmorph::cleanup
