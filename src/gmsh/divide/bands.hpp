// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Curves that face each other across a surface, or across a narrow part of one.

#include <vector>

#include "gmsh/divide/curves.hpp"
#include "parity/intervals.hpp"

namespace qmorph::adapter {

/// Rings and strips that are at most a few sizes thick, in pieces where points face each other; curves that face each
/// other from end to end in larger surfaces; and the opposite sides of surfaces with four corners, if they have nearly
/// the same number of segments.
std::vector<parity::Band> find_bands(const CurveModel& model);

}  // namespace qmorph::adapter
