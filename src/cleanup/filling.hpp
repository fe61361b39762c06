// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The quadrangulations of a ring with no irregular node inside, or with one: a grid between four corners; three or
/// five grids around a node between three or five corners. Their sides determine them. [Bunin06]

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "geometry/vec2.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

/// Corners are places in the ring, ascending. `spokes[i]` (of three or five corners): edges from the irregular node to
/// the side from corner i to the next.
struct Filling {
  int corners = 0;
  std::array<int, 5> corner{};
  std::array<int, 5> spokes{};
};

/// A path cuts a corner off the ring, from the place `ahead` edges after it to the one `back` edges before it. What is
/// cut off is filled between three corners, the rest between five. Either may have a spoke of no length: then its node
/// is on the cut.
struct PairFilling {
  int corner = 0;  ///< the place of the corner that is cut off
  int ahead = 0, back = 0;
  Filling triangle, pentagon;  ///< places count from the cut: from its end, and from its start
  Vec2 bend = Vec2::Zero();    ///< where the path turns, more or less

  int cut() const { return triangle.spokes[0] + triangle.spokes[1]; }
};

/// Quads of a filling of a ring with n edges.
int quads_of(const Filling& filling, int n);

/// The filling with these corners of a ring with n edges, if there is one: opposite sides of four corners are as long
/// as each other, spokes are at least one edge long.
std::optional<Filling> filling_between(std::span<const int> corners, int n);

/// Replaces the faces inside the ring (half-edges, inside on their left). Appends the new nodes and those of the ring
/// to `nodes`. False, perhaps half-way, if an edge that it needs is there already outside: to be called in a
/// transaction.
bool fill(kernel::Mesh& mesh, const std::vector<Index>& ring, const std::vector<Index>& faces, const Filling& filling,
          std::vector<Index>& nodes);

bool fill(kernel::Mesh& mesh, const std::vector<Index>& ring, const std::vector<Index>& faces,
          const PairFilling& filling, std::vector<Index>& nodes);

}  // namespace qmorph::cleanup
