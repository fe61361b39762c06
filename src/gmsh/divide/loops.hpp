// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The boundary of a surface as loops of curves.

#include <vector>

#include "gmsh/divide/curves.hpp"

namespace qmorph::adapter {

/// A curve as a loop runs along it.
struct DirectedCurve {
  Index curve = kNone;
  bool turned = false;  ///< from its end to its beginning
};
using Chain = std::vector<DirectedCurve>;

/// Each from the curve with the least number on. Empty if the curves do not make up loops that meet nowhere.
std::vector<Chain> loops_of(const CurveModel& model, const std::vector<Index>& boundary);

/// Positions of the curves at whose beginning a loop turns by more than so many degrees.
std::vector<std::size_t> corners_of(const CurveModel& model, const Chain& loop, double degrees);

}  // namespace qmorph::adapter
