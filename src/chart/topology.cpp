// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/topology.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "chart/local_numbers.hpp"
#include "kernel/loops.hpp"
#include "space/angle_sum.hpp"

namespace qmorph::chart {

std::vector<std::vector<Index>> loops_of(const Piece& piece) {
  std::vector<Index> next(piece.points.size(), kNone);
  for (Index side = 0; side < piece.open.size(); ++side)
    if (piece.open[side]) {
      const Face& face = piece.faces[side / 4];
      next[face[side % 4]] = face[next_corner(face, side % 4)];
    }
  return kernel::follow_loops(std::move(next));
}

int euler_characteristic(const Piece& piece) {
  std::size_t sides = piece.boundary_sides;
  for (const Face& face : piece.faces) sides += degree(face);
  return int(piece.points.size()) - int(sides / 2) + int(piece.faces.size());
}

bool is_planar_topology(const Piece& piece) {
  const auto loops = loops_of(piece);
  return !loops.empty() && euler_characteristic(piece) == 2 - int(loops.size());
}

std::vector<std::vector<Index>> components(const std::vector<Index>& faces, const std::vector<Index>& opposite,
                                           const std::vector<bool>& is_cut) {
  std::vector<Index> sorted = faces;
  if (!std::is_sorted(sorted.begin(), sorted.end())) std::sort(sorted.begin(), sorted.end());
  const LocalNumbers local(sorted, opposite.size() / 4);
  std::vector<Index> of(sorted.size(), kNone), some;
  std::vector<std::size_t> sizes;
  for (Index first = 0; first < sorted.size(); ++first) {
    if (of[first] != kNone) continue;
    of[first] = Index(sizes.size());
    some.assign(1, first);
    for (std::size_t k = 0; k < some.size(); ++k)
      for (Index side = 4 * sorted[some[k]]; side < 4 * sorted[some[k]] + 4; ++side) {
        if (opposite[side] == kNone || is_cut[side]) continue;
        const Index other = local[opposite[side] / 4];
        if (other == kNone || of[other] != kNone) continue;
        of[other] = of[first];
        some.push_back(other);
      }
    sizes.push_back(some.size());
  }
  std::vector<std::vector<Index>> result(sizes.size());
  for (std::size_t c = 0; c < sizes.size(); ++c) result[c].reserve(sizes[c]);
  for (std::size_t k = 0; k < sorted.size(); ++k) result[of[k]].push_back(sorted[k]);
  return result;
}

std::vector<double> angle_defects(const Piece& piece) {
  std::vector<double> defects(piece.points.size(), 2 * std::numbers::pi);
  for (Index side = 0; side < piece.open.size(); ++side)
    if (piece.open[side]) defects[piece.faces[side / 4][side % 4]] = std::numbers::pi;
  std::vector<space::AngleSum> sums(piece.points.size());
  for (const auto& t : piece.halves)
    for (int i = 0; i < 3; ++i)
      sums[t[i]].add(piece.points[t[(i + 1) % 3]] - piece.points[t[i]],
                     piece.points[t[(i + 2) % 3]] - piece.points[t[i]]);
  for (std::size_t v = 0; v < defects.size(); ++v) defects[v] -= sums[v].radians();
  return defects;
}

}  // namespace qmorph::chart
