// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Four corners whose opposite sides differ: there is no grid between them, but a mesh with one node of three edges and
/// one of five, which is all that is left of many irregular nodes that do not cancel. How far these two are from each
/// other follows from the sides; where they are does not.

#include <array>
#include <optional>
#include <vector>

#include "cleanup/filling.hpp"

namespace qmorph::cleanup {

/// Quads of a filling over those wanted: one that makes the elements coarser or finer than this is none.
struct FillingSize {
  double fewest = 0.75, most = 1.7;
};

/// What the pair should come near to.
struct PairWish {
  std::vector<Vec2> outline;
  Vec2 place;           ///< of the pair
  double quads_wanted;  ///< of the whole filling
  FillingSize size;
};

struct PairChoice {
  PairFilling filling;
  double misfit;  ///< how far it is from what was wished
};

/// The best filling between these places of the outline, which ascend. Nothing if opposite sides are the same or differ
/// so much that there is no room for the pair. Cost: the quads.
std::optional<PairChoice> pair_filling_between(const std::array<int, 4>& corners, const PairWish& wish);

}  // namespace qmorph::cleanup
