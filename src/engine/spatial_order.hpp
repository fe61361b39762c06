#pragma once
#include <vector>

#include "geometry/vec2.hpp"
#include "qmorph/patch.hpp"

namespace qmorph {

/// The triangles in the order of a Z-curve through their middles. What lies close together on the surface does so in memory,
/// however the mesher has numbered it: on a million triangles in random order that halves the time of a conversion.
/// [Morton66]
std::vector<Index> spatial_order(const std::vector<std::array<Index, 3>>& triangles, const std::vector<Vec2>& points);

}  // namespace qmorph
