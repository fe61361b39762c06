// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How many segments each curve of a model gets: as near to what is wished as possible, but so that the boundary of
/// each surface has an even number, and that curves that face each other across a band have the same.
///
/// This is interval assignment [Mitchell00]. Three steps stand for its integer program: curves that must or may be
/// alike become one; bands with several curves on a side are balanced along cheapest paths, as a flow is; what parities
/// are left to mend is a T-join (plan.hpp), whose paths keep the bands balanced.

#include <utility>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/index.hpp"

namespace qmorph::parity {

struct CurveWish {
  double wish = 1;     ///< length in sizes
  int segments = 1;    ///< what a mesher makes of it; 0 for a curve that has no length
  int least = 1;       ///< fewer will not do
  bool fixed = false;  ///< no other number will do
  double weight = 1;   ///< how much it counts that the number is off
};

/// Curves on one side of a band, and those that face them: both sides want as many segments.
struct Band {
  Index surface = kNone;
  std::vector<Index> one, other;
};

struct IntervalProblem {
  std::vector<CurveWish> curves;
  std::vector<std::vector<Index>> surfaces;     ///< their curves; one that has the surface on both sides twice
  std::vector<std::pair<Index, Index>> images;  ///< curves that must have as many as each other
  std::vector<Band> bands;
};

struct IntervalPlan {
  std::vector<int> segments;  ///< of each curve
  std::vector<Index> odd;     ///< surfaces that cannot be made even
  std::size_t fitting = 0;    ///< bands whose sides have as many segments
};

/// Never changes a fixed number, nor goes below the least. A curve of one segment is divided only if other ways are
/// much longer. As many surfaces become even as the curves allow. Cost: as `plan_cheapest`, and (segments that the
/// bands lack) * (curves).
QMORPH_API IntervalPlan plan_intervals(const IntervalProblem& problem);

}  // namespace qmorph::parity
