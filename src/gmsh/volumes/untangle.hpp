// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Moves nodes inside a volume until no element is turned over.

#include <cstddef>

#include "gmsh/volumes/solid.hpp"

namespace qmorph::adapter {

/// Only nodes near elements that are turned over move. \return how many are turned over in the end, never more than
/// before
std::size_t untangle(Solid& solid);

}  // namespace qmorph::adapter
