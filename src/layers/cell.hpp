// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Two triangles that may be one quad of a layer.

#include <array>
#include <optional>

#include "layers/sides.hpp"

namespace qmorph::layers {

/// Counter-clockwise: along the base, then back along the top. Sides are those of the two triangles.
struct Cell {
  std::array<Index, 4> nodes{};
  std::array<Index, 2> triangles{};
  Index base = kNone, right = kNone, top = kNone, left = kNone;
  std::array<double, 4> angles{};  ///< at the nodes
  double length = 0, height = 0;   ///< along the base and across it, means
  double aspect() const { return length / height; }
};

/// No corner is sharper than 4 degrees, or blunter than 176: where two walls meet in a sharp tip without a fan, the
/// last cells of both slant, as Gmsh's own quads do.
bool is_convex(const Cell& cell);

/// The cell on side `base` whose diagonal is `diagonal`, one of the other two sides of that triangle and no wall.
Cell make_cell(const Sides& sides, Index base, Index diagonal);

}  // namespace qmorph::layers
