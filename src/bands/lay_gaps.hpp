// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "engine/regions.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::bands {

/// A net of gaps as rows of quads along them. Each junction is given to one of its gaps, which begins with two rows
/// there, one on either side of the far corner; or to all three, with a node in its middle. Which get it follows from
/// the numbers of nodes on the gaps' sides, so that all become quads, and from what the rows are worth: a T-join.
/// If the boundary is odd, one junction stays a triangle. Nodes inside are half-way between the sides, and want
/// smoothing. Nothing if the region is no such net, or no rows are found for a gap. Cost: linear but for the T-join.
std::optional<kernel::Mesh> lay_gaps(const Region& region);

}  // namespace qmorph::bands
