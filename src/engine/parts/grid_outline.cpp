// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parts/grid_outline.hpp"

#include <cmath>
#include <numbers>

namespace qmorph {
namespace {

/// A boundary node is a corner below the first angle, between corners above the second; between the two it is neither.
constexpr double kCorner = 0.65 * std::numbers::pi, kSide = 0.85 * std::numbers::pi;

}  // namespace

bool has_grid_outline(const kernel::Mesh& mesh) {
  Index first = kNone;
  std::size_t boundary_nodes = 0;
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v)) continue;
    if (mesh.is_boundary(v)) first = v, ++boundary_nodes;
    if (!mesh.is_boundary(v) && mesh.is_fixed(v)) return false;
  }
  std::vector<std::size_t> corners;  // steps along the loop
  std::size_t steps = 0;
  if (first == kNone) return false;
  for (Index h : mesh.loop_from(mesh.out(first))) {
    const double angle = ccw_angle(-mesh.vector(mesh.prev(h)), mesh.vector(h));
    if (angle < kCorner)
      corners.push_back(steps);
    else if (angle < kSide || angle > 2 * std::numbers::pi - kSide)
      return false;
    ++steps;
  }
  return steps == boundary_nodes && corners.size() == 4 && corners[1] - corners[0] == corners[3] - corners[2] &&
         corners[2] - corners[1] == steps - (corners[3] - corners[0]);
}

}  // namespace qmorph
