// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Sizes of a mesh and of the one that it was made from.

#include <map>
#include <vector>

#include "qmorph/gmsh.hpp"
#include "qmorph/patch.hpp"

namespace qmorph::adapter {

/// The triangles and quads of each surface of the current model that has some, by tag, whatever they are.
/// \throws InputError if an element uses a node that does not exist
std::map<int, Patch> read_surfaces();

/// Sets `conversion.sizes` of the surfaces of the current model that are in `before` as well.
void compare_sizes(const std::map<int, Patch>& before, ModelReport& model);

}  // namespace qmorph::adapter
