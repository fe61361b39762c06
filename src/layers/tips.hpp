// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "qmorph/patch.hpp"

namespace qmorph::layers {

/// At the tip of a fan, two triangles that have become a quad are nearly straight where the second row begins. There
/// the node goes outwards, along the edge to the next row, until the corner is good enough or the next row's would be
/// worse. No other node of a layer ever moves, and no more than one in a hundred of the quads in layers changes: the
/// worst do.
/// \param first the quads from there on are pairs at tips
/// \param layer_quads how many quads of the patch are in layers
void widen_tips(Patch& patch, std::size_t first, std::size_t layer_quads);

}  // namespace qmorph::layers
