// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "qmorph/patch.hpp"

namespace qmorph::layers {

/// At the tip of a fan, two triangles that have become a quad are nearly straight where the second row begins. There
/// the node goes outwards, along the edge to the next row, until the corner is good enough or the next row's would be
/// worse. No other node of a layer ever moves, and no more than one in a hundred of the quads in layers changes: the
/// worst do.
/// \param given the first quads, which the input had: their nodes stay
/// \param pairs the last quads, at tips
void widen_tips(Patch& patch, std::size_t given, std::size_t pairs);

}  // namespace qmorph::layers
