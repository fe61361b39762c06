// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "qmorph/patch.hpp"

namespace qmorph::layers {

/// Sets of a few triangles without a node inside, as they are left at the tip of a fan, have one way at most to become
/// quads. Where those have no sharp and no blunt corner, they are taken: a front would put nodes between, closer to
/// each other than rows are. A whole row that leans is left to it.
/// \return how many quads are new, at the end of `patch.quads`
std::size_t pair_remnants(Patch& patch);

}  // namespace qmorph::layers
