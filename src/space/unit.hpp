// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

namespace qmorph::space {

/// The vector's direction; zero for a vector without length, or with NaN.
inline Eigen::Vector3d unit(const Eigen::Vector3d& v) {
  const double length = v.norm();
  return length > 0 ? Eigen::Vector3d(v / length) : Eigen::Vector3d::Zero();
}

}  // namespace qmorph::space
