// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Boundary layers and structured strips in a triangle mesh: the quads that their triangles are halves of.
///
/// Columns of cells march from walls (curves and the boundary): the wall edge is one side of a cell, of the other two
/// edges of its triangle that one is the diagonal which leaves angles nearer to 90 degrees, and the side opposite is
/// the next cell's base. "Pairs across the longest edge" would not do: on a curved wall, cells that are flat enough
/// have their diagonal shorter than one of their sides.

#include <optional>

#include "qmorph/patch.hpp"

namespace qmorph::layers {

/// A patch whose layers are quads already.
struct Layers {
  /// `triangles` are those that are left. To `quads` the layers' are added, and to `points` those in the middle of
  /// columns that were cut in two so that nothing odd is left between layers. No other point is new, and none has
  /// moved but those at tips (tips.hpp).
  Patch patch;
  std::size_t quads = 0;                     ///< of layers
  std::size_t regions = 0, odd_regions = 0;  ///< of triangles, joined through edges that are no walls, before
};

/// Nothing if the patch has no layers. Points need not lie in a plane.
/// \param without nodes around which nothing is a layer, by row of `Patch::points`
/// \param crease_angle as in Options: rows may end at sharp edges as at walls
/// Cost: linear in the triangles, a few nanoseconds for each where there are none that are thin.
std::optional<Layers> find_layers(const Patch& patch, const std::vector<bool>& without, double crease_angle);

}  // namespace qmorph::layers
