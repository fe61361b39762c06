// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <utility>

#include "space/background.hpp"

namespace qmorph::space {

/// Edges along which two triangles of a surface meet at more than `angle` (radians, between their normals), lower node
/// first, sorted. Triangles without height do not count.
std::vector<std::pair<Index, Index>> find_creases(const Background& surface, double angle);

}  // namespace qmorph::space
