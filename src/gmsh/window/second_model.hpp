// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A second model, shown beside the first.

#include <Eigen/Core>
#include <limits>
#include <string>

#include "gmsh/window/snapshot.hpp"

namespace qmorph::adapter {

/// Copies the surfaces' triangles into a model of their own, to the right of the first, and has Gmsh recombine them.
/// That model is current as long as this object lives; it is shown until the next one replaces it.
class SecondModel {
 public:
  /// \throws InputError
  explicit SecondModel(const Snapshot& triangles);
  ~SecondModel();
  SecondModel(const SecondModel&) = delete;
  SecondModel& operator=(const SecondModel&) = delete;

 private:
  std::string first_;
  /// Box around both.
  Eigen::Vector3d low_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
};

/// Removes it, if there is one.
void remove_second_model();

}  // namespace qmorph::adapter
