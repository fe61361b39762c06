// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/pair.hpp"

#include <algorithm>
#include <numbers>
#include <set>

#include "layers/cell.hpp"
#include "layers/remnants.hpp"
#include "layers/walls.hpp"

namespace qmorph::layers {
namespace {

constexpr std::size_t kFew = 16;

/// Joined by inner edges, triangles without a node inside are a tree: a leaf has one neighbour to be paired with, and
/// so on. Nothing if a triangle is left over, or a quad would be poor.
std::vector<Cell> pair_tree(const Sides& sides, std::vector<Index> triangles) {
  std::vector<Cell> cells;
  while (!triangles.empty()) {
    bool has_leaf = false;
    for (Index t : triangles) {
      const auto is_open = [&](Index c) {
        return !sides.is_wall(c) && std::count(triangles.begin(), triangles.end(), sides.opposite(c) / 3);
      };
      std::vector<Index> open;
      for (Index c = 3 * t; c < 3 * t + 3; ++c)
        if (is_open(c)) open.push_back(c);
      if (open.empty()) return {};  // alone
      if (open.size() > 1) continue;
      cells.push_back(make_cell(sides, Sides::next(open[0]), open[0]));
      if (!is_convex(cells.back())) return {};
      std::erase_if(triangles, [&](Index u) { return u == t || u == sides.opposite(open[0]) / 3; });
      has_leaf = true;
      break;
    }
    if (!has_leaf) return {};
  }
  return cells;
}

/// A whole row of quads that lean like that is better laid anew, with room for other rows (bands/relay_rows.hpp).
bool is_leaning_row(const std::vector<Cell>& cells) {
  constexpr double kLeans = 27 * std::numbers::pi / 180;
  return cells.size() >= kRow && std::all_of(cells.begin(), cells.end(), [](const Cell& cell) {
           return *std::min_element(cell.angles.begin(), cell.angles.end()) < kLeans;
         });
}

}  // namespace

std::size_t pair_remnants(Patch& patch) {
  const Sides sides(patch);
  const Parts parts = all_parts(sides);
  std::vector<std::vector<Index>> members(parts.sizes.size());
  for (Index t = 0; t < parts.part_of.size(); ++t)
    if (parts.sizes[parts.part_of[t]] <= kFew) members[parts.part_of[t]].push_back(t);
  std::vector<std::array<Index, 4>> quads;
  std::vector<bool> is_paired(patch.triangles.size(), false);
  for (const auto& part : members) {
    std::set<Index> nodes;
    for (Index t : part) nodes.insert(patch.triangles[t].begin(), patch.triangles[t].end());
    if (part.size() % 2 != 0 || nodes.size() != part.size() + 2) continue;
    const std::vector<Cell> cells = pair_tree(sides, part);
    if (is_leaning_row(cells)) continue;
    for (const Cell& cell : cells) {
      quads.push_back(cell.nodes);
      for (Index t : cell.triangles) is_paired[t] = true;
    }
  }
  std::vector<std::array<Index, 3>> left;
  for (Index t = 0; t < patch.triangles.size(); ++t)
    if (!is_paired[t]) left.push_back(patch.triangles[t]);
  patch.triangles = std::move(left);
  patch.quads.insert(patch.quads.end(), quads.begin(), quads.end());
  return quads.size();
}

}  // namespace qmorph::layers
