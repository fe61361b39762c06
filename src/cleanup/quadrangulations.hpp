// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// All ways to fill a small ring with quads, by what their valences cost: an exact search by branch and bound.

#include <cstddef>
#include <vector>

#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

/// A node of the ring.
struct RingNode {
  int outer = 2;              ///< edges that are not inside the ring; its two of the ring count
  int ideal = 4;              ///< edges that should meet there
  int fewest = 2, most = 63;  ///< edges that may
  Vec2 point = Vec2::Zero();
  bool moves = true;  ///< when the filling is smoothed
};

/// A quad on the first edge of a polygon with the nodes 0, 1, ..., m - 1: its other corners are the nodes `ahead` (next
/// to node 1) and `back` (next to node 0) of the polygon, or new ones. What is left of the polygon is filled by the
/// next steps, in the order of Quadrangulation.
struct FillStep {
  static constexpr int kNew = -1;
  int ahead = kNew, back = kNew;
};

struct Quadrangulation {
  int cost = 0;                 ///< sum of (edges - ideal)^2, also of the new nodes, whose ideal is 4
  std::vector<FillStep> steps;  ///< one for each quad
};

struct SearchLimits {
  int most_cost = 0;
  int most_inner = 0;             ///< new nodes; each has three to five edges
  std::size_t most_found = 16;    ///< the cheapest are kept
  std::size_t most_steps = 6000;  ///< of the search: then it ends with what it has
  /// Of a corner between nodes that do not move; other corners between nodes of the ring need only be convex.
  double least_sine = 0;
};

/// The cheapest fillings of the ring (counter-clockwise), the cheapest first; equally cheap ones as they are found.
/// `ring`: an even number of nodes, at least four. Adds the steps of the search to `steps`.
std::vector<Quadrangulation> find_quadrangulations(const std::vector<RingNode>& ring, const SearchLimits& limits,
                                                   std::size_t& steps);

/// Replaces the faces inside the ring (half-edges, inside on their left) by the quadrangulation's quads. New nodes are
/// in the middle of the ring; appends them to `nodes`. False, perhaps half-way, if an edge that it needs is there
/// already outside: to be called in a transaction.
bool fill(kernel::Mesh& mesh, const std::vector<Index>& ring, const std::vector<Index>& faces,
          const Quadrangulation& quadrangulation, std::vector<Index>& nodes);

}  // namespace qmorph::cleanup
