// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "engine/regions.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::canonical {

/// What belongs to a region whose coordinates were rounded.
struct Rounding {
  std::vector<Vec2> exact;  ///< the region's points as they were
  Plane plane;              ///< has its origin in the corner of the region's box
  Vec2 corner = Vec2::Zero();
};

/// Moves the region's points so that the corner of their box is the origin, and rounds them to steps that are far
/// smaller than the triangles, but far larger than what a computer rounds: a surface that is moved becomes the same
/// quads, nearly always. Else noise would decide where edges are equally long.
/// \return nothing, and the points are as they were, where a triangle is too small for that
std::optional<Rounding> round_points(Region& region, const Plane& plane);

/// Nodes of the rounded region that did not move get their exact coordinates, the others come along.
void put_back(kernel::Mesh& mesh, const Rounding& rounding, const Region& region);

}  // namespace qmorph::canonical
