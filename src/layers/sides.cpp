// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/sides.hpp"

#include <algorithm>
#include <utility>

namespace qmorph::layers {
namespace {

/// One side, or (side kNone) a constraint, in the list of its lower node.
struct Entry {
  Index upper, side;
};

/// Entries in the order of their lower nodes; those of node v are first[v] up to first[v + 1].
struct ByLowerNode {
  std::vector<std::size_t> first;
  std::vector<Entry> entries;
};

ByLowerNode sort_by_lower_node(const Patch& patch) {
  ByLowerNode list;
  list.first.assign(patch.points.size() + 2, 0);
  const auto for_each_entry = [&](const auto& visit) {
    for (Index c = 0; c < 3 * patch.triangles.size(); ++c) {
      const auto& t = patch.triangles[c / 3];
      visit(t[c % 3], t[(c + 1) % 3], c);
    }
    for (const auto& [a, b] : patch.constraints) visit(a, b, kNone);
    for (const auto& q : patch.quads)
      for (std::size_t i = 0; i < 4; ++i) visit(q[i], q[(i + 1) % 4], kNone);
  };
  for_each_entry([&](Index a, Index b, Index) { ++list.first[std::min(a, b) + 2]; });
  for (std::size_t v = 2; v < list.first.size(); ++v) list.first[v] += list.first[v - 1];
  list.entries.resize(list.first.back());
  for_each_entry([&](Index a, Index b, Index c) { list.entries[list.first[std::min(a, b) + 1]++] = {std::max(a, b), c}; });
  return list;
}

}  // namespace

Sides::Sides(const Patch& patch) : patch_(patch), opposite_(3 * patch.triangles.size(), kNone) {
  ByLowerNode list = sort_by_lower_node(patch);
  const auto at = [&](std::size_t i) { return list.entries.begin() + std::ptrdiff_t(i); };
  for (std::size_t v = 0; v < patch.points.size(); ++v) {
    std::sort(at(list.first[v]), at(list.first[v + 1]),
              [](const Entry& a, const Entry& b) { return std::pair(a.upper, a.side) < std::pair(b.upper, b.side); });
    for (std::size_t i = list.first[v]; i < list.first[v + 1];) {
      std::size_t end = i + 1;
      while (end < list.first[v + 1] && list.entries[end].upper == list.entries[i].upper) ++end;
      const Index a = list.entries[i].side, b = list.entries[end - 1].side;
      if (end - i == 2 && b != kNone && from(a) == to(b)) opposite_[a] = b, opposite_[b] = a;
      i = end;
    }
  }
}

Index Sides::next_wall(Index c) const {
  for (c = next(c); !is_wall(c);) c = next(opposite(c));
  return c;
}

Index Sides::previous_wall(Index c) const {
  for (c = previous(c); !is_wall(c);) c = previous(opposite(c));
  return c;
}

}  // namespace qmorph::layers
