// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "engine/regions.hpp"
#include "qmorph/error.hpp"

namespace qmorph {

/// Throws SurfaceError if a coordinate is not finite, an index is out of range or an element has a node twice.
void require_sound(const Patch& patch);

/// By more than rounding. A triangle without area is not.
bool is_turned_over(const std::array<Vec2, 3>& corners);
SurfaceError turned_over(const std::array<Vec2, 3>& corners, const Plane& plane, std::optional<ErrorSubject> subject);

/// Throws SurfaceError if a triangle is turned over.
void require_fronts(const std::vector<Region>& regions, const Plane& plane);

/// Throws SurfaceError if the surface lies over itself: a node that its triangles go round more than once, triangles
/// that overlap at a place of the outline, or boundary or constraint edges that cross. What is not found is an island
/// that lies within other triangles as a whole, and an outline that passes itself exactly at a node in the middle of an
/// edge.
/// Cost: linear in the triangles; a sweep over the boundary edges.
void require_no_overlap(const std::vector<Region>& regions, const Plane& plane);

}  // namespace qmorph
