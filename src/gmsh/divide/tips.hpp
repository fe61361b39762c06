// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Longer segments where two curves that touch, or nearly do, run out in a tip.

#include <vector>

#include "gmsh/divide/curves.hpp"

namespace qmorph::adapter {

/// A quad in a tip is no better than the sine of the angle between the first segments of its sides. Where the sides are
/// bent apart, that angle grows with these segments, so both become as long as a decent quad asks for, up to a few
/// sizes; behind them sizes fall off again to what they were. Marks where the first segments end (DividedCurve::tips).
/// \param may_change by curve: whether its nodes may be others than Gmsh's
/// \pre within run_logged(); `model` is not cut into pieces
CurveModel mark_tips(CurveModel model, const std::vector<bool>& may_change);

}  // namespace qmorph::adapter
