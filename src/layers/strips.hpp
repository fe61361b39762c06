// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Rows of cells that stand on no wall.

#include "layers/cells.hpp"

namespace qmorph::layers {

/// Takes strips of thin triangles. Across its long edges each is joined to two others, so that they form columns; of
/// the two ways to make a column into pairs, that one is taken which leaves less, or is less askew, or goes on straight
/// with the rows of the columns beside it. From there columns march up and down.
/// \param thin triangles, among them all whose longest side is more than kStart times the height on it
void take_strips(Cells& cells, const std::vector<Index>& thin);

/// Takes what is left between cells and walls, where it is rows and columns to the last triangle.
void fill_gaps(Cells& cells);

}  // namespace qmorph::layers
