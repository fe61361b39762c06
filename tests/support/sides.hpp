// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The sides of all elements of a mesh, sorted by edge: what the checkers look at.

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "qmorph/patch.hpp"

namespace qmorph::test {

/// One side of one element. Triangles are elements 0, 1, ...; quads follow.
struct Side {
  Index low = 0, high = 0;
  bool forward = true;  ///< the element has it as low -> high
  Index element = 0;
  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

inline std::vector<Side> sides_of(const std::vector<std::array<Index, 3>>& triangles,
                                  const std::vector<std::array<Index, 4>>& quads) {
  std::vector<Side> sides;
  Index element = 0;
  const auto add = [&](const auto& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Index from = nodes[i], to = nodes[(i + 1) % nodes.size()];
      sides.push_back({std::min(from, to), std::max(from, to), from < to, element});
    }
    ++element;
  };
  for (const auto& t : triangles) add(t);
  for (const auto& q : quads) add(q);
  std::sort(sides.begin(), sides.end(), [](const Side& l, const Side& r) {
    return std::tie(l.low, l.high, l.forward, l.element) < std::tie(r.low, r.high, r.forward, r.element);
  });
  return sides;
}

/// Calls visit(first, last) for each edge with the range of its sides.
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, Visit&& visit) {
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const Side& s) { return !s.same_edge(*first); });
    visit(first, last);
    first = last;
  }
}

}  // namespace qmorph::test
