// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <string>

namespace qmorph {

/// "(x, y, z)" with six digits, for messages.
std::string describe(const Eigen::Vector3d& p);

}  // namespace qmorph
