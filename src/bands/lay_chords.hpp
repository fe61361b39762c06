// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Small regions with room for no node inside: blades, wedges, slivers.

#include <array>
#include <optional>
#include <vector>

#include "engine/regions.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::bands {

struct Chords {
  std::vector<std::array<Index, 4>> faces;  ///< places of the polygon's nodes; a triangle's last one is kNone
  std::size_t looks = 0;                    ///< quads looked at
};

/// The best quads between the nodes of a polygon, counter-clockwise, and one triangle if they are odd in number. Best
/// is the least sum of 1 / scaled Jacobian, so that the worst counts for most; found by dynamic programming over the
/// chords. No faces if there is no way. Cost: nodes^4 at worst.
Chords best_chords(std::vector<Vec2> polygon);

/// The best quads between the nodes of a region's boundary alone, and one triangle where it has an odd number of sides,
/// as best_chords(). Nothing if the boundary is more than one loop or too long, if there is a fixed node inside, or room
/// for more than a few free ones, or if there is no way. Cost: at most 0.3 million quads looked at.
std::optional<kernel::Mesh> lay_chords(const Region& region);

}  // namespace qmorph::bands
