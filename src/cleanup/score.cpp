// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace qmorph::cleanup {

int Score::boundary_ideal(Index v) const {
  if (boundary_ideal_.size() <= v) boundary_ideal_.resize(mesh_.vertex_slots(), 0);
  if (boundary_ideal_[v] == 0) {
    const double quads = std::round(inside_angle(v) / (0.5 * std::numbers::pi));
    boundary_ideal_[v] = static_cast<signed char>(1 + std::clamp(int(quads), 1, 4));
  }
  return boundary_ideal_[v];
}

double Score::inside_angle(Index v) const {
  // Counter-clockwise from the edge before the boundary half-edge to that half-edge lies the inside.
  const Index out = mesh_.out(v);
  const double angle = ccw_angle(-mesh_.vector(mesh_.prev(out)), mesh_.vector(out));
  return angle > 0 ? angle : 2 * std::numbers::pi;  // 0: the tip of a slit
}

}  // namespace qmorph::cleanup
