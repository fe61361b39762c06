// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// From where a scene in space is seen.

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "report/scene.hpp"

namespace qmorph::report {

/// From the model to the eye; of no length: from where the scene is seen best.
using Viewpoint = Eigen::Vector3d;

/// "x", "-y", "+z", or "1,-2,0.5". Null if it is no direction.
std::optional<Viewpoint> find_viewpoint(std::string_view name);

/// How a scene is turned about its frame's up, then about the horizontal: angles in radians.
struct Turn {
  double up = 0, right = 0;
  /// Rows: to the right, upwards and to the eye, in coordinates of the frame.
  Eigen::Matrix3d rows() const;
};

/// None for a flat scene that is seen from where it is seen best; a scene in space is then seen from the side and
/// above.
Turn turn_of(const Frame& frame, const Viewpoint& from);

}  // namespace qmorph::report
