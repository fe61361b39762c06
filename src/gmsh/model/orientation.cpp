// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/orientation.hpp"

namespace qmorph::adapter {
namespace {

struct Link {
  Index to = 0;
  bool agrees = true;  ///< the two elements run along their edge in opposite senses, as they should
};

/// Neighbours through edges, packed: those of element e are links[begin[e]] to links[begin[e + 1]].
struct Neighbours {
  std::vector<std::size_t> begin;
  std::vector<Link> links;
};

Neighbours find_neighbours(std::size_t elements, const std::vector<Side>& sides) {
  Neighbours result;
  result.begin.assign(elements + 1, 0);
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() == 2)
      for (const Side& side : edge) ++result.begin[side.element + 1];
  });
  for (std::size_t e = 0; e < elements; ++e) result.begin[e + 1] += result.begin[e];
  result.links.resize(result.begin[elements]);
  std::vector<std::size_t> next(result.begin.begin(), result.begin.end() - 1);
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() != 2) return;
    const bool agrees = edge[0].forward != edge[1].forward;
    result.links[next[edge[0].element]++] = {edge[1].element, agrees};
    result.links[next[edge[1].element]++] = {edge[0].element, agrees};
  });
  return result;
}

/// Walks one part from `seed` and notes which elements run against the majority.
void walk_part(Index seed, const Neighbours& neighbours, Orientation& result) {
  std::vector<Index> members{seed};
  result.part[seed] = result.parts;
  std::size_t flipped = 0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Index e = members[i];
    flipped += result.flip[e];
    for (std::size_t k = neighbours.begin[e]; k < neighbours.begin[e + 1]; ++k) {
      const Link& link = neighbours.links[k];
      if (result.part[link.to] != kNone) continue;
      result.part[link.to] = result.parts;
      result.flip[link.to] = result.flip[e] == link.agrees;
      members.push_back(link.to);
    }
  }
  if (2 * flipped > members.size()) {
    for (Index e : members) result.flip[e] = !result.flip[e];
    flipped = members.size() - flipped;
  }
  result.flipped += flipped;
  ++result.parts;
}

}  // namespace

Orientation orient_where_possible(std::size_t elements, const std::vector<Side>& sides) {
  Orientation result;
  result.part.assign(elements, kNone);
  result.flip.assign(elements, false);
  const Neighbours neighbours = find_neighbours(elements, sides);
  for (Index e = 0; e < elements; ++e)
    if (result.part[e] == kNone) walk_part(e, neighbours, result);
  return result;
}

Orientation orient(std::size_t elements, const std::vector<Side>& sides) {
  Orientation result = orient_where_possible(elements, sides);
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() > 2) result.of_many.push_back({edge[0].low, edge[0].high});
  });
  if (result.flipped == 0) return result;

  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() != 2 || result.defect) return;
    const bool agrees = edge[0].forward != edge[1].forward;
    if ((result.flip[edge[0].element] == result.flip[edge[1].element]) == agrees) return;
    result.defect = "it has no orientation, like a Moebius strip: it turns over at an edge";
    result.where = edge[0];
  });
  return result;
}

}  // namespace qmorph::adapter
