// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>

#include "qmorph/patch.hpp"

namespace qmorph::canonical {

/// Axes of a surface's own, by its shape: the model's, exchanged and turned round. A surface that is rotated by right
/// angles or mirrored has the same coordinates along them, bit for bit.
struct Frame {
  std::array<int, 3> axis{0, 1, 2};     ///< of the model, for each of ours
  std::array<double, 3> sign{1, 1, 1};  ///< -1 where ours runs the other way
  std::array<double, 3> origin{0, 0,
                               0};  ///< along each of ours, a coordinate of the model; not 0 across a flat surface
  bool turns_over = false;          ///< elements are seen from their other side

  Eigen::Vector3d to_own(const Eigen::Vector3d& model) const;
  Eigen::Vector3d to_model(const Eigen::Vector3d& own) const;
  Eigen::Vector3d direction_to_model(const Eigen::Vector3d& own) const;
  /// 1, or -1 where ours are left-handed.
  double handedness() const;
  /// Elements run round the other way if one looks at them along our axes: a positive angle of the model is negative.
  bool is_mirrored() const { return turns_over != (handedness() < 0); }
};

/// The frame of a patch with elements, whose indices are in range and whose coordinates are finite.
///
/// Of the 48 ways to exchange and turn the axes, those for which moments of the middles of the elements are largest,
/// one moment after another; those that agree within rounding are told apart by the coordinates themselves. A surface
/// that one of the ways lays onto itself, exactly, has no frame that is its own: then it is the first of them.
/// Cost: linear.
Frame find_frame(const Patch& patch);

}  // namespace qmorph::canonical
