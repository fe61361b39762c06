// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <vector>

#include "chart/flat_shape.hpp"

namespace qmorph::chart {

/// Points of a chart that are in place but for what a few edges make among themselves, brought to where flatten() would
/// have them: a few percent of what is wrong there are left, without anything to factorise. Each step turns the
/// triangles and moves each point along what pulls it, by Chebyshev's iteration [Saad03]. Cost: linear.
void relax_flat(const space::Background& surface, std::span<const Shape> shapes, std::vector<Vec2>& points);

}  // namespace qmorph::chart
