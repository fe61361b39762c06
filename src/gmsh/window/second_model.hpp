// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Another model beside the one that is shown.

#include <Eigen/Core>
#include <limits>
#include <string>

#include "gmsh/window/snapshot.hpp"

namespace qmorph::adapter {

/// Makes a model of the surfaces' triangles, to the right of where they are, and lets Gmsh recombine them. It is the
/// current model as long as this lives; it is shown afterwards, too, until the next one replaces it.
class SecondModel {
 public:
  /// \throws InputError
  explicit SecondModel(const Snapshot& triangles);
  ~SecondModel();
  SecondModel(const SecondModel&) = delete;
  SecondModel& operator=(const SecondModel&) = delete;

 private:
  std::string first_;
  /// Around both.
  Eigen::Vector3d low_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
};

/// Takes it away, if it is there.
void remove_second_model();

}  // namespace qmorph::adapter
