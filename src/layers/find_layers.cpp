// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/find_layers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "layers/chance_rows.hpp"
#include "layers/pair.hpp"
#include "layers/remnants.hpp"
#include "layers/strips.hpp"
#include "layers/tips.hpp"
#include "layers/walls.hpp"

namespace qmorph::layers {
namespace {

/// Longest side over the height on it. A cell with which a layer begins has a half of more than kStart.
bool is_thin(const Patch& patch, const std::array<Index, 3>& t) {
  const Eigen::Vector3d a = patch.points[t[1]] - patch.points[t[0]], b = patch.points[t[2]] - patch.points[t[1]],
                        c = patch.points[t[0]] - patch.points[t[2]];
  return std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}) > kStart * a.cross(b).norm();
}

/// A quick look: false if thin triangles are too few, or too far from each other, to be a row of cells.
bool may_be_row(const Patch& patch, const std::vector<Index>& thin) {
  std::vector<std::pair<Index, Index>> at_node;  // thin triangles, by their numbers among these
  for (Index i = 0; i < thin.size(); ++i)
    for (Index v : patch.triangles[thin[i]]) at_node.emplace_back(v, i);
  std::sort(at_node.begin(), at_node.end());
  std::vector<Index> joined(thin.size());
  std::vector<std::size_t> count(thin.size(), 1);
  for (Index i = 0; i < thin.size(); ++i) joined[i] = i;
  const auto find = [&](Index i) {
    while (joined[i] != i) i = joined[i] = joined[joined[i]];
    return i;
  };
  for (std::size_t i = 1; i < at_node.size(); ++i) {
    if (at_node[i].first != at_node[i - 1].first) continue;
    const Index a = find(at_node[i].second), b = find(at_node[i - 1].second);
    if (a == b) continue;
    joined[a] = b;
    count[b] += count[a];
    if (count[b] >= 2 * kRow) return true;
  }
  return false;
}

/// Writes what the cells and cuts leave of a patch.
class Writer {
 public:
  Writer(const Cells& cells, const std::vector<Cut>& cuts) : cells_(cells), sides_(cells.sides()) {
    const Patch& patch = sides_.patch();
    out_.points = patch.points;
    out_.is_smooth = patch.is_smooth;
    out_.quads = patch.quads;
    out_.constraints = patch.constraints;
    out_.fixed = patch.fixed;
    for (const Cut& cut : cuts) {
      middle_of(cut.start);
      middle_of(cut.end);
      for (Index i : cut.cells) is_cut_[i] = true, middle_of(cells_[i].base), middle_of(cells_[i].top);
    }
  }

  Patch write() {
    for (Index i = 0; i < cells_.size(); ++i)
      if (cells_.is_live(i)) write_cell(i);
    for (Index t = 0; t < sides_.count() / 3; ++t)
      if (!cells_.is_taken(t)) write_triangle(t);
    return std::move(out_);
  }

 private:
  /// Of a side that a cut crosses, seen from both triangles; made at the first call.
  Index middle_of(Index c) {
    const auto [it, is_new] = middles_.try_emplace(std::min(c, sides_.opposite(c)), Index(out_.points.size()));
    if (is_new) out_.points.push_back((sides_.point(sides_.from(c)) + sides_.point(sides_.to(c))) / 2);
    return it->second;
  }

  Index find_middle(Index c) const {
    if (middles_.empty()) return kNone;
    const auto it = middles_.find(std::min(c, sides_.opposite(c)));
    return it == middles_.end() ? kNone : it->second;
  }

  void write_cell(Index i) {
    const auto& [p, q, r, s] = cells_[i].nodes;
    if (!is_cut_.contains(i)) {
      out_.quads.push_back(cells_[i].nodes);
      return;
    }
    const Index below = find_middle(cells_[i].base), above = find_middle(cells_[i].top);
    out_.quads.push_back({p, below, above, s});
    out_.quads.push_back({below, q, r, above});
  }

  /// The corners and the middles of crossed sides, cut into triangles.
  void write_triangle(Index t) {
    std::array<Index, 3> n = sides_.patch().triangles[t], m{};
    for (Index i = 0; i < 3; ++i) m[i] = find_middle(3 * t + i);
    const auto count = std::count_if(m.begin(), m.end(), [](Index i) { return i != kNone; });
    // Turned so that a single middle is on the first side, and two are on the first and the second.
    while (count % 3 != 0 && (m[0] == kNone || (count == 2 && m[1] == kNone))) {
      std::rotate(n.begin(), n.begin() + 1, n.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    }
    auto& out = out_.triangles;
    if (count == 0) out.push_back(n);
    if (count == 1) out.insert(out.end(), {{n[0], m[0], n[2]}, {m[0], n[1], n[2]}});
    if (count == 2) out.insert(out.end(), {{m[0], n[1], m[1]}, {n[0], m[0], m[1]}, {n[0], m[1], n[2]}});
    if (count == 3)
      out.insert(out.end(), {{n[0], m[0], m[2]}, {m[0], n[1], m[1]}, {m[1], n[2], m[2]}, {m[0], m[1], m[2]}});
  }

  const Cells& cells_;
  const Sides& sides_;
  Patch out_;
  std::map<Index, Index> middles_;  ///< points, by the lower of an edge's two sides
  std::map<Index, bool> is_cut_;    ///< by cell
};

void drop_cells_at(Cells& cells, const std::vector<bool>& nodes) {
  for (Index i = 0; i < cells.size(); ++i)
    if (cells.is_live(i) &&
        std::any_of(cells[i].nodes.begin(), cells[i].nodes.end(), [&](Index v) { return nodes[v]; }))
      cells.drop(i);
}

/// make_even(), but if cuts would go through a large share of all cells, those are left to the front: a grid whose rows
/// end in a triangle each would become twice as fine.
std::vector<Cut> make_even_by_few_cuts(Cells& cells, const Parts& regions) {
  constexpr double kMostCut = 0.25;
  std::vector<Cut> cuts = make_even(cells, regions);
  std::size_t cut = 0, all = 0;
  for (const Cut& one : cuts) cut += one.cells.size();
  for (Index i = 0; i < cells.size(); ++i) all += cells.is_live(i);
  if (double(cut) <= kMostCut * double(all)) return cuts;
  for (const Cut& one : cuts)
    for (Index i : one.cells) cells.drop(i);
  return make_even(cells, regions);
}

}  // namespace

std::optional<Layers> find_layers(const Patch& patch, const std::vector<bool>& without, double crease_angle) {
  std::vector<Index> thin;
  for (Index t = 0; t < patch.triangles.size(); ++t)
    if (is_thin(patch, patch.triangles[t])) thin.push_back(t);
  if (!may_be_row(patch, thin)) return std::nullopt;
  const Sides sides(patch, crease_angle);
  Cells cells(sides);
  const std::vector<Column> columns = take_columns_on_walls(cells);
  take_fans(cells, columns);
  take_strips(cells, thin);
  go_on_along_walls(cells);
  if (cells.size() == 0) return std::nullopt;
  const Parts regions = all_parts(sides);
  drop_broken_rows(cells, regions);
  fill_gaps(cells);
  drop_chance_rows(cells, thin);
  drop_cells_at(cells, without);
  const std::vector<Cut> cuts = make_even_by_few_cuts(cells, regions);
  Layers layers;
  layers.patch = Writer(cells, cuts).write();
  const std::size_t pairs = pair_remnants(layers.patch);
  layers.quads = layers.patch.quads.size() - patch.quads.size();
  widen_tips(layers.patch, patch.quads.size(), pairs);
  if (layers.quads == 0) return std::nullopt;
  layers.regions = regions.sizes.size();
  for (Index i = 0; i < regions.sizes.size(); ++i) layers.odd_regions += regions.is_odd(i);
  return layers;
}

}  // namespace qmorph::layers
