// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Right angles and mirrors, which round no coordinate; and what they leave the same.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "qmorph/patch.hpp"

namespace qmorph::test {

inline constexpr std::size_t kSymmetries = 48;
/// One of the ways to exchange and turn the axes; 0 is the identity.
Eigen::Matrix3d symmetry(std::size_t number);

/// Elements as sets of places, so that numbers and directions are out of the way.
using Elements = std::vector<std::vector<std::array<double, 3>>>;
Elements elements_of(const Patch& patch, const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity());
Elements elements_of(const QuadMesh& mesh, const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity());

/// Whether one of the ways lays the patch upon itself: then what becomes of it and the image of that are equally good.
bool is_symmetric(Patch patch);

}  // namespace qmorph::test
