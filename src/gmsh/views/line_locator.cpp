// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/views/line_locator.hpp"

#include <algorithm>
#include <limits>

namespace qmorph::adapter {
namespace {

std::array<std::size_t, 2> ends_of(const Line& line) {
  const std::size_t* nodes = line.block->nodes.data() + line.element * line.block->nodes_per_element;
  return {nodes[0], nodes[1]};
}

}  // namespace

LineLocator::LineLocator(const ModelMesh& mesh) : mesh_(mesh) {
  for (const EntityMesh& entity : mesh.entities)
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t e = 0; entity.dim == 1 && e < block.tags.size(); ++e)
        for (const std::size_t node : ends_of({&block, e})) at_[{entity.tag, node}].push_back({&block, e});
}

std::optional<Line> LineLocator::find(int curve, const std::array<std::size_t, 2>& ends,
                                      const Eigen::Vector3d& middle) const {
  std::optional<Line> nearest;
  double distance = std::numeric_limits<double>::infinity();
  for (const std::size_t node : ends) {
    const auto lines = at_.find({curve, node});
    if (lines == at_.end()) continue;
    for (const Line& line : lines->second) {
      const std::array<std::size_t, 2> has = ends_of(line);
      if (std::minmax(has[0], has[1]) == std::minmax(ends[0], ends[1])) return line;
      const auto [a, b] = chord(line);
      const double here = (middle - (a + (1 + parameter(line, middle)) / 2 * (b - a))).norm();
      if (here >= distance) continue;
      nearest = line;
      distance = here;
    }
  }
  return nearest;
}

double LineLocator::parameter(const Line& line, const Eigen::Vector3d& point) const {
  const auto [a, b] = chord(line);
  const double squared = (b - a).squaredNorm();
  return squared > 0 ? std::clamp(2 * (point - a).dot(b - a) / squared - 1, -1.0, 1.0) : 0;
}

std::array<Eigen::Vector3d, 2> LineLocator::chord(const Line& line) const {
  const auto [a, b] = ends_of(line);
  return {mesh_.points[mesh_.rows.find(a)], mesh_.points[mesh_.rows.find(b)]};
}

}  // namespace qmorph::adapter
