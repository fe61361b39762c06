// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>

#include "geometry/vec2.hpp"
#include "qmorph/patch.hpp"

namespace qmorph::test {

/// The smallest sine of a corner of a quad, of a mesh in the plane z = 0.
inline double least_of(const QuadMesh& mesh) {
  double least = 1;
  for (const auto& q : mesh.quads) {
    const auto p = [&](std::size_t i) -> Vec2 { return mesh.points[q[i]].head<2>(); };
    least = std::min(least, smallest_corner_sine(p(0), p(1), p(2), p(3)));
  }
  return least;
}

}  // namespace qmorph::test
