// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Rows that nobody has made.

#include "layers/cells.hpp"

namespace qmorph::layers {

/// Among triangles that are stretched, and no halves of anything, some look like rows by chance. Drops blocks of cells
/// (those that hang together) which are ragged: small for the sides on which thin triangles go on that are no cells. If
/// cells lean as halves of stretched equilateral triangles do, few such sides are enough.
/// \param thin as in take_strips()
void drop_chance_rows(Cells& cells, const std::vector<Index>& thin);

}  // namespace qmorph::layers
