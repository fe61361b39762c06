// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the triangles of a surface stand for.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::adapter {

/// A point of a triangle of the input.
struct OnInput {
  Eigen::Vector3d point, weights;
  std::array<Index, 3> corners;  ///< rows of the model's nodes
};

/// The point of the shape for it.
struct Landing {
  Eigen::Vector3d point;
  Eigen::Vector2d parameters = Eigen::Vector2d::Zero();  ///< of a surface of a geometry
  bool found = false;  ///< `parameters` are a guess if not, and `point` is the input's
};

class Shape {
 public:
  Shape() = default;
  virtual ~Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  virtual std::vector<Landing> land(std::span<const OnInput> points) const = 0;
  /// Whether the parameters mean something.
  virtual bool has_parameters() const = 0;
};

}  // namespace qmorph::adapter
