// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "chart/surface_mesh.hpp"

namespace qmorph::chart {

/// Paths along edges of a piece that join its loops, and the tips of its cones, to one another: cut along all of them, it is a
/// disc. The longest loops come first. Each path is a list of points.
std::vector<std::vector<Index>> opening_paths(const Piece& piece);

}  // namespace qmorph::chart
