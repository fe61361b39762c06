// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The best rows of quads between two polylines that must stay, by dynamic programming.

#include <vector>

#include "geometry/vec2.hpp"
#include "qmorph/patch.hpp"

namespace qmorph::cleanup {

/// A place in a band: either a rung from lower node `lower` to upper node `upper`, or a node half-way between them,
/// where the band has two rows.
struct BandPlace {
  Index lower, upper;
  bool two_rows;
};

struct BandPlan {
  std::vector<BandPlace> places;  ///< from the first rung to the last
  double cost = 0;                ///< mean of 1 - scaled Jacobian, and something for each irregular node
};

/// From the rung between the first nodes to the one between the last. Each change from one row to two or back passes an
/// edge of one side alone, which is how a lean of the rungs, and a difference of the numbers of edges, is taken up.
/// Empty if there is no plan. Precondition: both have two nodes at least; sizes differ by `most_lag` at most. Cost:
/// length times most_lag.
BandPlan plan_band(const std::vector<Vec2>& lower, const std::vector<Vec2>& upper, int most_lag);

}  // namespace qmorph::cleanup
