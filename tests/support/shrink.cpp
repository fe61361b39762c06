// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/shrink.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "support/domains.hpp"
#include "support/sides.hpp"

namespace qmorph::test {
namespace {

/// Drops what nothing uses any more, so that the patch is one again.
Patch tidied(const Patch& patch) {
  Patch result;
  std::vector<Index> row(patch.points.size(), kNone);
  const auto mark = [&](const auto& elements) {
    for (const auto& nodes : elements)
      for (const Index i : nodes) row[i] = 0;
  };
  mark(patch.triangles);
  mark(patch.quads);
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == kNone) continue;
    row[i] = Index(result.points.size());
    result.points.push_back(patch.points[i]);
  }
  const auto renumber = [&](auto elements) {
    for (auto& nodes : elements)
      for (Index& i : nodes) i = row[i];
    return elements;
  };
  result.triangles = renumber(patch.triangles);
  result.quads = renumber(patch.quads);
  const auto sides = sides_of(result.triangles, result.quads);
  for (const auto& nodes : patch.constraints) {
    const auto [a, b] = std::minmax(row[nodes[0]], row[nodes[1]]);
    const bool is_edge = std::any_of(sides.begin(), sides.end(),
                                     [&, low = a, high = b](const Side& s) { return s.low == low && s.high == high; });
    if (is_edge) result.constraints.push_back({row[nodes[0]], row[nodes[1]]});
  }
  for (const Index i : patch.fixed)
    if (row[i] != kNone) result.fixed.push_back(row[i]);
  return result;
}

/// Tries to do without runs of `list` (a member of `patch`), from half of it down to single ones. True if any went.
template <class List, class Fails>
bool thin_out(Patch& patch, List Patch::*list, const Fails& fails) {
  bool any = false;
  for (std::size_t run = std::max<std::size_t>((patch.*list).size() / 2, 1); run > 0; run /= 2)
    for (std::size_t first = 0; first < (patch.*list).size();) {
      Patch less = patch;
      auto& items = less.*list;
      items.erase(items.begin() + std::ptrdiff_t(first),
                  items.begin() + std::ptrdiff_t(std::min(first + run, items.size())));
      less = tidied(less);
      if (!less.triangles.empty() && broken_inputs(less).empty() && fails(less)) {
        patch = less;
        any = true;
      } else {
        first += run;
      }
    }
  return any;
}

/// Elements from left to right, so that a run of them lies together.
void sort_by_place(Patch& patch) {
  const auto place = [&](const auto& nodes) {
    double sum = 0;
    for (const Index i : nodes) sum += patch.points[i].x() + 0.9 * patch.points[i].y() + 0.8 * patch.points[i].z();
    return sum / double(nodes.size());
  };
  const auto before = [&](const auto& l, const auto& r) { return place(l) < place(r); };
  std::stable_sort(patch.triangles.begin(), patch.triangles.end(), before);
  std::stable_sort(patch.quads.begin(), patch.quads.end(), before);
}

}  // namespace

Patch shrunk(Patch patch, const std::function<bool(const Patch&)>& fails) {
  Patch sorted = patch;
  sort_by_place(sorted);
  if (fails(sorted)) patch = sorted;
  for (bool any = true; any;) {
    any = thin_out(patch, &Patch::triangles, fails);
    any = thin_out(patch, &Patch::quads, fails) || any;
    any = thin_out(patch, &Patch::constraints, fails) || any;
    any = thin_out(patch, &Patch::fixed, fails) || any;
  }
  return patch;
}

}  // namespace qmorph::test
