// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <utility>
#include <vector>

#include "kernel/ids.hpp"

namespace qmorph::kernel {

/// The loops that lead from node to node, each once and from its lowest node on. `next` has by node the one that
/// follows, or kNone. Where two loops share a node, the one is cut short.
inline std::vector<std::vector<Index>> follow_loops(std::vector<Index> next) {
  std::vector<std::vector<Index>> loops;
  for (Index first = 0; first < next.size(); ++first) {
    if (next[first] == kNone) continue;
    std::vector<Index>& loop = loops.emplace_back();
    for (Index v = first; next[v] != kNone;) {
      loop.push_back(v);
      v = std::exchange(next[v], kNone);
    }
  }
  return loops;
}

}  // namespace qmorph::kernel
