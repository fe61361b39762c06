// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Triangles of a surface in the plane, with the lengths and angles that they have in space as far as that is possible.

#include <optional>
#include <span>
#include <vector>

#include "geometry/vec2.hpp"
#include "space/background.hpp"

namespace qmorph::chart {

/// A surface laid flat.
struct Flattening {
  std::vector<Vec2> points;  ///< by row of the surface's points
  /// 99th percentile of the larger over the smaller factor by which a triangle's lengths have changed.
  double distortion = 1;
  /// The same of the larger factor by which lengths have grown or shrunk.
  double scaling = 1;
  std::size_t flipped = 0;  ///< triangles that are turned over, or have no area
  std::size_t work = 0;     ///< that it took to turn triangles back, as kernel::Mesh::work() counts it
};

/// Rounds: until they gain nothing, or as many as do for a window that is thrown away soon.
inline constexpr int kAllRounds = 30, kFewRounds = 4;

/// As rigid as possible [Liu08]: unfolded from triangle to triangle first, then rotations and points in turn. Each
/// piece of the surface has a boundary; it may have holes. A cone, a tube that is cut open, a plate are flattened
/// exactly; elsewhere the result says how far off it is. Cost: one sparse factorisation, some solves: near
/// linear.
/// \param lengths by side of the surface, to flatten with instead of those in space
Flattening flatten(const space::Background& surface, std::size_t points, int rounds = kAllRounds,
                   std::span<const double> lengths = {});

/// The same for points that are in place but for what a few edges make among themselves (relax_flat.hpp). Nothing if
/// triangles are turned over then. Cost: linear.
std::optional<Flattening> flatten_from(const space::Background& surface, std::vector<Vec2> start);

}  // namespace qmorph::chart
