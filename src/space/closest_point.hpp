// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Core>

namespace qmorph::space {

/// A point of a triangle, by its weights at the corners.
struct OnTriangle {
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), weights = Eigen::Vector3d::UnitX();
  double distance2 = 0;  ///< square of the distance to the point asked for
};

/// Weight at b of the point of segment ab that is closest to p; 0 if the segment has no length.
double closest_on_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// The point of triangle abc that is closest to p, by the regions of corners, sides and inside [Ericson05]. Triangles
/// without area are right, too: the closest point of their sides.
OnTriangle closest_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                               const Eigen::Vector3d& c);

}  // namespace qmorph::space
