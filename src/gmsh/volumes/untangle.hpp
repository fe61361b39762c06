// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Moves nodes inside a volume until no element is turned over.

#include <cstddef>
#include <vector>

#include "gmsh/volumes/solid.hpp"

namespace qmorph::adapter {

/// Only nodes near elements that are turned over move.
/// \param turned find_turned() of the solid
/// \return the same in the end, never more than before
std::vector<std::size_t> untangle(Solid& solid, std::vector<std::size_t> turned);

}  // namespace qmorph::adapter
