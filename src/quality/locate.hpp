// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <vector>

#include "qmorph/index.hpp"

#include <Eigen/Core>

namespace qmorph {

/// For each place the triangle that it lies in, or very near to; kNone if there is none.
/// Cost: n log m for n triangles and m places.
std::vector<Index> locate(const std::vector<Eigen::Vector3d>& places, const std::vector<Eigen::Vector3d>& points,
                          const std::vector<std::array<Index, 3>>& triangles);

}  // namespace qmorph
