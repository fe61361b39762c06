// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::space {

/// For each side of elements the same edge's side in the other element. kNone on the boundary and where the surface
/// parts: at `barriers`, at edges with three elements or more, and between elements that are not oriented alike.
/// `ends(side)` gives the nodes that a side runs from and to; the first is kNone if there is no such side. Linear for
/// meshes, even where thousands of elements meet at a node.
template <class Ends>
std::vector<Index> link_sides(std::size_t nodes, Index sides, const Ends& ends,
                              std::span<const std::array<Index, 2>> barriers) {
  struct Edge {
    Index other, side, following;  ///< edges of the same node make a chain
    bool is_barrier;
  };
  std::vector<Index> count(nodes, 0), first(nodes, kNone);
  for (Index side = 0; side < sides; ++side)
    if (const auto [a, b] = ends(side); a != kNone) ++count[a], ++count[b];
  std::vector<Edge> edges;
  edges.reserve(sides / 2 + barriers.size());
  const auto edge_of = [&](Index a, Index b) -> Edge& {
    // In the chain of the node that has fewer: where thousands meet, the others have few.
    const auto [few, many] = std::minmax({std::pair(count[a], a), std::pair(count[b], b)});
    const Index at = few.second, other = many.second;
    for (Index e = first[at]; e != kNone; e = edges[e].following)
      if (edges[e].other == other) return edges[e];
    edges.push_back({other, kNone, first[at], false});
    first[at] = Index(edges.size() - 1);
    return edges.back();
  };
  for (const auto& [a, b] : barriers) edge_of(a, b).is_barrier = true;

  std::vector<Index> opposite(sides, kNone);
  for (Index side = 0; side < sides; ++side) {
    const auto [a, b] = ends(side);
    if (a == kNone) continue;
    Edge& edge = edge_of(a, b);
    if (edge.is_barrier) continue;
    const Index other = edge.side;
    if (other == kNone) {
      edge.side = side;
    } else if (opposite[other] == kNone && ends(other).first == b && a != b) {
      opposite[side] = other, opposite[other] = side;
    } else {
      edge.is_barrier = true;
      if (opposite[other] != kNone) opposite[opposite[other]] = kNone;
      opposite[other] = kNone;
    }
  }
  return opposite;
}

}  // namespace qmorph::space
