// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The quadrangulations of a ring with no irregular node inside, or with one: a grid between four corners; three or
/// five grids around a node between three or five corners. Their sides determine them. [Bunin06]

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

/// Corners are places in the ring, ascending. `spokes[i]` (of three or five corners): edges from the irregular node to
/// the side from corner i to the next.
struct Filling {
  int corners = 0;
  std::array<int, 5> corner{};
  std::array<int, 5> spokes{};
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

}  // namespace qmorph::cleanup
