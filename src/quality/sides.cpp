// SPDX-License-Identifier: GPL-2.0-or-later
#include "quality/sides.hpp"

#include <algorithm>
#include <tuple>

namespace qmorph {
namespace {

template <std::size_t N, class Visit>
void visit_sides(std::span<const std::array<Index, N>> elements, Index first_element, Visit&& visit) {
  for (Index e = 0; e < elements.size(); ++e)
    for (std::size_t k = 0; k < N; ++k) {
      const Index a = elements[e][k], b = elements[e][(k + 1) % N];
      visit(Side{std::min(a, b), std::max(a, b), first_element + e, a < b});
    }
}

}  // namespace

std::vector<Side> sorted_sides(std::size_t points, std::span<const std::array<Index, 3>> triangles,
                               std::span<const std::array<Index, 4>> quads) {
  const auto visit_all = [&](auto&& visit) {
    visit_sides<3>(triangles, 0, visit);
    visit_sides<4>(quads, static_cast<Index>(triangles.size()), visit);
  };
  std::vector<std::size_t> begin(points + 1, 0);
  visit_all([&](const Side& side) { ++begin[side.low + 1]; });
  for (std::size_t i = 0; i < points; ++i) begin[i + 1] += begin[i];
  std::vector<Side> sides(begin[points]);
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  visit_all([&](const Side& side) { sides[next[side.low]++] = side; });
  for (std::size_t i = 0; i < points; ++i)
    std::sort(sides.begin() + begin[i], sides.begin() + begin[i + 1], [](const Side& a, const Side& b) {
      return std::tuple(a.high, a.element, a.forward) < std::tuple(b.high, b.element, b.forward);
    });
  return sides;
}

}  // namespace qmorph
