// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The best rows of quads between the two sides of a band, by dynamic programming.

#include <vector>

#include "geometry/vec2.hpp"
#include "qmorph/patch.hpp"

namespace qmorph::bands {

/// From one rung of a band to the next. A rung has a node on each side, and one between any two rows.
/// `row`: a column of quads, along an edge of both sides. The others pass an edge of one side alone: a column comes in
/// there, `level` rows from the other side it turns and goes on as a row of its own (`more`), or a row does so the
/// other way (`fewer`). That leaves a node with three edges and one with five. Or there is a triangle on that edge, and
/// the other nodes of the rung stay (`wedge`): once, if the boundary is odd.
struct Step {
  enum Kind : unsigned char { row, more, fewer, wedge } kind = row;
  bool above = false;  ///< along `upper`
  unsigned char level = 0;
};

struct RowPlan {
  std::vector<Step> steps;
  double cost = 0;
  Index first_rows = 1;
};

/// What is to be filled: sides from the first rung to the last, as points.
struct Rails {
  std::vector<Vec2> lower, upper;
  std::vector<Index> facing;  ///< of each lower node, an upper one nearby
  std::vector<double> rows;   ///< how many are wanted there
  int first_rows = 1, last_rows = 1;
};

/// What is bad, in quads of scaled Jacobian 0.
struct RowCosts {
  double change;  ///< a node with three edges and one with five
  double pair;    ///< a change that follows another at once, so that they share these nodes
  double turn;    ///< times what the worst quad at a change lacks of a good one
};
/// Where rungs have to lean, neither is always better in the end.
inline constexpr RowCosts kBetterTurns{0.3, 0.4, 2}, kFewerTurns{0.9, 0.3, 0};

/// Without steps if there is no plan. Cost: linear.
RowPlan plan_rows(const Rails& rails, const RowCosts& costs);

}  // namespace qmorph::bands
