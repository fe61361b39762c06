// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// From the regions of a patch back to one surface.

#include <utility>
#include <vector>

#include "engine/regions.hpp"
#include "kernel/mesh.hpp"

namespace qmorph {

/// Puts the regions of one patch together again. Keeps references to everything that it is given.
class Collector {
 public:
  Collector(const Patch& patch, const Plane& plane, const std::vector<Vec2>& plane_points);

  void add(const Region& region, const kernel::Mesh& mesh);
  /// Kept quads of the patch first, then the regions' elements. Nodes that did not move keep their coordinates to the
  /// bit.
  QuadMesh finish();

 private:
  Index append(const Eigen::Vector3d& p, Index source);
  void add_elements(const Region& region, const kernel::Mesh& mesh);

  const Patch& patch_;
  const Plane& plane_;
  const std::vector<Vec2>& plane_points_;
  std::vector<Index> row_;
  std::vector<bool> used_;
  std::vector<std::pair<const Region*, const kernel::Mesh*>> parts_;
  QuadMesh result_;
};

}  // namespace qmorph
