// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::space {

/// For each side of elements the same edge's side in the other element. kNone on the boundary and where the surface
/// parts: at `barriers`, at edges with three elements or more, and between elements that are not oriented alike.
/// `ends(side)` gives the nodes that a side runs from and to; the first is kNone if there is no such side. Linear for
/// meshes.
template <class Ends>
std::vector<Index> link_sides(std::size_t nodes, Index sides, const Ends& ends,
                              std::span<const std::array<Index, 2>> barriers) {
  struct Edge {
    Index upper, side, following;  ///< edges with the same lower node make a chain
    bool is_barrier;
  };
  std::vector<Index> first(nodes, kNone);
  std::vector<Edge> edges;
  edges.reserve(sides / 2 + barriers.size());
  const auto edge_of = [&](Index a, Index b) -> Edge& {
    const auto [low, high] = std::minmax(a, b);
    for (Index e = first[low]; e != kNone; e = edges[e].following)
      if (edges[e].upper == high) return edges[e];
    edges.push_back({high, kNone, first[low], false});
    first[low] = Index(edges.size() - 1);
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
