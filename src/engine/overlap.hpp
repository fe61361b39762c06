// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "engine/regions.hpp"

namespace qmorph {

/// Throws SurfaceError if an index is out of range or a triangle has a node twice.
void require_sound(const Patch& patch);

/// Throws SurfaceError if the surface lies over itself: a node that its triangles go round more than once, or
/// boundary or constraint edges that cross. With positive triangles and neither, nothing overlaps.
/// Cost: linear in the triangles; a sweep over the boundary edges.
void require_no_overlap(const std::vector<Region>& regions, const Plane& plane);

}  // namespace qmorph
