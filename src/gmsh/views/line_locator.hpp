// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Which line element of a curve another one was made from.

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// A line element of a mesh.
struct Line {
  const ElementBlock* block = nullptr;
  std::size_t element = 0;  ///< of the block
};

/// The line elements of all curves, by the nodes at their ends.
class LineLocator {
 public:
  /// \pre `mesh` lives longer than the locator
  explicit LineLocator(const ModelMesh& mesh);
  /// The line of the curve between these nodes, or the one that has got a node in its middle, of which this is a half:
  /// that has one end in common and is nearest to the half's middle. Nothing if no line ends at either node.
  std::optional<Line> find(int curve, const std::array<std::size_t, 2>& ends, const Eigen::Vector3d& middle) const;
  /// Where the foot of a point is on the chord of a line: -1 at its first node, 1 at its second one.
  double parameter(const Line& line, const Eigen::Vector3d& point) const;

 private:
  std::array<Eigen::Vector3d, 2> chord(const Line& line) const;

  const ModelMesh& mesh_;
  std::map<std::pair<int, std::size_t>, std::vector<Line>> at_;  ///< by curve and node
};

}  // namespace qmorph::adapter
