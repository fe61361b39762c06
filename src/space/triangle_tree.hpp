// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <span>
#include <vector>

#include "qmorph/export.hpp"
#include "space/background.hpp"

namespace qmorph::space {

/// Finds the closest of many triangles to any point, without a hint. Arrays that it is made of must outlive it.
/// Cost: n log n to make, about log n for a point.
class QMORPH_API TriangleTree {
 public:
  TriangleTree(std::span<const Eigen::Vector3d> points, std::span<const Background::Triangle> triangles);

  /// The closest point of all triangles; of several equally near triangles one, always the same. No triangle:
  /// `triangle` is kNone. Only points nearer than `within` are looked for, on triangles t with label[t] == only;
  /// without labels on all.
  Foot closest(const Eigen::Vector3d& p, double within = std::numeric_limits<double>::infinity(),
               std::span<const Index> label = {}, Index only = 0) const;

 private:
  static constexpr std::size_t kLeaf = 4;  ///< triangles

  std::span<const Eigen::Vector3d> points_;
  std::span<const Background::Triangle> triangles_;
  std::vector<Index> order_;  ///< triangles along a curve that fills space, those of a leaf one after another
  std::vector<Eigen::AlignedBox3d> of_triangle_;  ///< in this order
  /// A complete binary tree: node n has the children 2 n and 2 n + 1, the root is 1, leaves come last.
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::size_t leaves_ = 1;
};

}  // namespace qmorph::space
