// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/flat_shapes.hpp"

#include <algorithm>
#include <cmath>

namespace qmorph::space {

void FlatShapes::look_around(const MeshOnSurface& mesh, Index v, const Eigen::Vector3d& axis_u,
                             const Eigen::Vector3d& axis_v) {
  const auto laid = [&](Index node) {
    const Eigen::Vector3d way = mesh.point(node) - mesh.point(v);
    return Vec2(way.dot(axis_u), way.dot(axis_v));
  };
  spokes_.clear();
  mesh.for_sides_around(v, [&](Index side) { spokes_.emplace_back().end = laid(mesh.node(mesh.next(side))); });
  std::size_t i = 0;
  mesh.for_sides_around(v, [&](Index side) {
    Spoke& spoke = spokes_[i];
    const Vec2& end = spokes_[++i == spokes_.size() ? 0 : i].end;
    if (chart::degree(mesh.mesh().faces[side / 4]) == 4) {
      const Vec2 corner = laid(mesh.node(mesh.next(mesh.next(side))));
      spoke.ahead = (corner - spoke.end).normalized();
      spoke.behind = (corner - end).normalized();
      spoke.opposite = cross(spoke.behind, spoke.ahead);
    } else {
      spoke.ahead = (end - spoke.end).normalized();
      spoke.behind = -spoke.ahead;
    }
  });
}

double FlatShapes::sines(const Vec2& p) const {
  const auto from_node = [&](const Spoke& spoke) -> Vec2 {
    const Vec2 way = spoke.end - p;
    return way / std::sqrt(way.squaredNorm());
  };
  double sum = 0;
  Vec2 here = from_node(spokes_[0]);
  const Vec2 first = here;
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    const Spoke& spoke = spokes_[i];
    const Vec2 there = i + 1 == spokes_.size() ? first : from_node(spokes_[i + 1]);
    const double at_ends = std::min(cross(here, spoke.ahead), cross(spoke.behind, there));
    sum += std::min(std::min(spoke.opposite, cross(here, there)), at_ends);
    here = there;
  }
  return sum;
}

}  // namespace qmorph::space
