// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the corners of surfaces ask of the curves that meet there.

#include "gmsh/divide/curves.hpp"
#include "parity/intervals.hpp"

namespace qmorph::adapter {

/// Sides between the three corners of a surface get two segments at least, and the numbers of curves that meet in an
/// acute corner count for more.
void heed_corners(const CurveModel& model, parity::IntervalProblem& problem);

}  // namespace qmorph::adapter
