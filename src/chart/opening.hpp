// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "chart/surface_mesh.hpp"

namespace qmorph::chart {

/// Paths along edges of a piece that join its loops, and the tips of its cones, to one another: cut along all of them,
/// it is a disc. The longest loops come first. Each path is a list of points. `defects` as angle_defects(piece).
std::vector<std::vector<Index>> opening_paths(const Piece& piece, const std::vector<double>& defects);

/// Whether a tip, a boundary point with one node before and after it, may be narrow in a chart, by the angles in space
/// there: the end of a cut. The end of a line inside is not.
bool may_have_narrow_tip(const Piece& piece);

/// Where the corner of a tip is so narrow that one quad would fill it, that quad would have the node twice. A path that
/// halves the first such corner; empty if there is none.
std::vector<Index> path_from_narrow_tip(const Piece& piece, const std::vector<Vec2>& flat);

}  // namespace qmorph::chart
