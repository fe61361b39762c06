// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace qmorph::space {

/// A sum of angles between vectors, as the angle of a product of complex numbers: one arc tangent does for all of them.
class AngleSum {
 public:
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const double cosine = a.dot(b), sine = a.cross(b).norm(), size = std::abs(cosine) + sine;
    if (!(size > 0)) return;
    const double x = x_ * cosine - y_ * sine, y = x_ * sine + y_ * cosine;
    if (y == 0 && x_ < 0 && cosine < 0) {  // two half turns
      half_turns_ += 2, x_ = 1, y_ = 0;
      return;
    }
    half_turns_ += y < 0;  // what is left is less than another one
    const double scale = (y < 0 ? -1 : 1) / size;
    x_ = scale * x, y_ = std::abs(scale * y);
    if (const double length = std::abs(x_) + y_; length < kSmall) x_ /= length, y_ /= length;
  }
  double radians() const { return half_turns_ * std::numbers::pi + std::atan2(y_, x_); }

 private:
  static constexpr double kSmall = 1e-100;
  double x_ = 1, y_ = 0;  ///< at the angle that is left, from 0 to pi
  int half_turns_ = 0;
};

}  // namespace qmorph::space
