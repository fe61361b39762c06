// SPDX-License-Identifier: GPL-2.0-or-later
#include "quality/valence.hpp"

#include <algorithm>

namespace qmorph {
namespace {

template <std::size_t N, class Visit>
void visit_edges(std::span<const std::array<Index, N>> elements, Visit&& visit) {
  for (const auto& nodes : elements)
    for (std::size_t i = 0; i < N; ++i) {
      const auto [low, high] = std::minmax(nodes[i], nodes[(i + 1) % N]);
      visit(low, high);
    }
}

}  // namespace

NodeDegrees node_degrees(std::size_t node_count, std::span<const std::array<Index, 3>> triangles,
                         std::span<const std::array<Index, 4>> quads) {
  const auto visit_all = [&](auto&& visit) {
    visit_edges(triangles, visit);
    visit_edges(quads, visit);
  };
  // Bucket `low` holds the other ends of all element sides whose smaller node is `low`.
  std::vector<std::size_t> start(node_count + 1, 0);
  visit_all([&](Index low, Index) { ++start[low + 1]; });
  for (std::size_t i = 0; i < node_count; ++i) start[i + 1] += start[i];
  std::vector<Index> ends(start[node_count]);
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  visit_all([&](Index low, Index high) { ends[next[low]++] = high; });

  NodeDegrees degrees{std::vector<int>(node_count, 0), std::vector<std::uint8_t>(node_count, 0)};
  for (std::size_t low = 0; low < node_count; ++low) {
    const auto first = ends.begin() + std::ptrdiff_t(start[low]), last = ends.begin() + std::ptrdiff_t(start[low + 1]);
    std::sort(first, last);
    for (auto it = first; it != last;) {
      const Index high = *it;
      const auto same = std::find_if(it, last, [&](Index other) { return other != high; });
      ++degrees.edges[low];
      ++degrees.edges[high];
      if (same - it == 1) degrees.boundary[low] = degrees.boundary[high] = 1;
      it = same;
    }
  }
  return degrees;
}

}  // namespace qmorph
