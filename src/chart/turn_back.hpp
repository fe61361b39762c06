// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "geometry/vec2.hpp"
#include "space/background.hpp"

namespace qmorph::chart {

/// Moves the corners of triangles that are turned over, or have no area, to where the smallest sine around is largest,
/// one at a time; those of the boundary, too. False if there are too many for that, and then nothing is moved. Cost: in
/// proportion to their number; it is added to `work`, as kernel::Mesh::work() counts it.
bool turn_back(const space::Background& surface, std::vector<Vec2>& points, std::size_t& work);

}  // namespace qmorph::chart
