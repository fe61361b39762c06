// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/divide/corners.hpp"

#include <algorithm>

#include "gmsh/divide/loops.hpp"

namespace qmorph::adapter {
namespace {

/// Rows run from each of three sides to both others, so each needs room for two. With one segment on two of them, and
/// two on the third for an even sum, a single quad would be straight in one of its corners.
void halve_sides(const Chain& triangle, parity::IntervalProblem& problem) {
  for (const DirectedCurve& side : triangle) {
    int& least = problem.curves[side.curve].least;
    least = std::max(least, 2);
  }
}

/// A quad that fits into an acute corner has sides that are as long as each other, which curves divided by the sizes
/// give it.
void add_weight(const Chain& loop, std::size_t corner, parity::IntervalProblem& problem) {
  constexpr double kWeight = 4;
  for (std::size_t i : {corner, (corner + loop.size() - 1) % loop.size()})
    problem.curves[loop[i].curve].weight = kWeight;
}

}  // namespace

void heed_corners(const CurveModel& model, parity::IntervalProblem& problem) {
  constexpr double kTurn = 45, kAcuteTurn = 130;  // degrees
  for (const BoundedSurface& surface : model.surfaces) {
    std::vector<Index> boundary = surface.boundary;
    std::erase_if(boundary, [&](Index c) { return model.curves[c].segments == 0; });
    const std::vector<Chain> loops = loops_of(model, boundary);
    if (loops.size() == 1 && loops[0].size() == 3 && corners_of(model, loops[0], kTurn).size() == 3)
      halve_sides(loops[0], problem);
    for (const Chain& loop : loops)
      for (std::size_t corner : corners_of(model, loop, kAcuteTurn)) add_weight(loop, corner, problem);
  }
}

}  // namespace qmorph::adapter
