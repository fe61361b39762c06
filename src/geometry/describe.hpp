// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Places in messages.

#include <Eigen/Core>
#include <string>

#include "qmorph/export.hpp"

namespace qmorph {

/// "(1.5, 2, 0)", all three with the same last place: six digits of the largest coordinate, and six behind the point
/// where it is larger than one, so that nodes of a map in metres, far from its origin, are told apart.
QMORPH_API std::string describe(const Eigen::Vector3d& p);

}  // namespace qmorph
