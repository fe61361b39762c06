// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <span>
#include <vector>

#include "qmorph/index.hpp"

#include <Eigen/Core>

namespace qmorph {

/// For each place the quad that it lies in, or very near to, quads being two triangles each; kNone if there is none.
/// Cost: n log m for n quads and m places.
std::vector<Index> locate(const std::vector<Eigen::Vector3d>& places, const std::vector<Eigen::Vector3d>& points,
                          std::span<const std::array<Index, 4>> quads);

}  // namespace qmorph
