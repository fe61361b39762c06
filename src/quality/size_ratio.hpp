// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How long the edges of a result are, measured by those of the input nearby.

#include <vector>

#include "qmorph/patch.hpp"

namespace qmorph {

/// For each inner edge of `after` (one with two elements): its length over the median length of the 12 edges of
/// `before` whose middles are nearest to its own. 1: quads are as long as the triangles were, there, however sizes are
/// graded.
/// Cost: n log n.
std::vector<double> size_ratios(const Patch& before, const QuadMesh& after);

}  // namespace qmorph
