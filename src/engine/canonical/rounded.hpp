// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "engine/regions.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::canonical {

/// A region from the corner of its box on, its coordinates rounded to steps that are far smaller than its triangles,
/// but far larger than what a computer rounds: a surface that is moved becomes the same quads, nearly always. Else
/// noise would decide where edges are equally long.
struct Rounded {
  Region region;
  Plane plane;  ///< has its origin in the corner
  Vec2 corner = Vec2::Zero();
};

/// Nothing where a triangle is too small for that.
std::optional<Rounded> rounded(const Region& region, const Plane& plane);

/// Nodes that did not move get the coordinates of `region`, the others come along.
void put_back(kernel::Mesh& mesh, const Rounded& from, const Region& region);

}  // namespace qmorph::canonical
