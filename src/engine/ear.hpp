// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Where the boundary is odd, one triangle stays. In a sharp corner of the boundary it does least harm: a quad there
/// would be poor. An ear is a triangle with two sides on the boundary; its tip is the corner between them.

#include <optional>

#include "engine/regions.hpp"
#include "kernel/mesh.hpp"

namespace qmorph {

struct Ear {
  std::size_t triangle = 0;  ///< row of Region::triangles
  Index before, tip, after;  ///< its nodes, counter-clockwise
};

/// The ear with the sharpest tip, of those sharper than 60 degrees. Nothing if there is none, or nothing beside it.
std::optional<Ear> sharpest_ear(const Region& region);

/// The region without the ear. Nodes keep their numbers; the tip has no element any more.
Region cut_off(const Region& region, const Ear& ear);

/// Gives the ear back to a mesh of the region without it.
void put_back(kernel::Mesh& mesh, const Ear& ear);

}  // namespace qmorph
