// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/lay_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "bands/gap_net.hpp"
#include "bands/lay_gap.hpp"
#include "parity/plan.hpp"

namespace qmorph::bands {
namespace {

class GapLayer {
 public:
  GapLayer(const Region& region, GapNet net)
      : region_(region), net_(std::move(net)), doubled_(net_.gaps.size()), takers_(net_.junctions, 0) {}

  std::optional<kernel::Mesh> run() {
    if (!choose()) return {};
    for (std::size_t g = 0; g < net_.gaps.size(); ++g)
      for (int e : {0, 1})
        if (doubled_[g][e] && net_.gaps[g].ends[e].junction != kNone) ++takers_[net_.gaps[g].ends[e].junction];
    points_ = region_.points;
    if (std::find(takers_.begin(), takers_.end(), 2) != takers_.end()) return {};
    find_middles();
    for (std::size_t g = 0; g < net_.gaps.size(); ++g) draw_gap(g);
    draw_junctions();
    kernel::Mesh mesh(points_, faces_, {});
    mesh.add_work(work_);
    return mesh;
  }

 private:
  /// Decides which ends have two rows. At a junction their number is odd; a gap's is as odd as its sides together, so
  /// that of two ways there are to choose from one changes both its ends.
  bool choose() {
    std::vector<bool> odd(net_.junctions, true);
    const auto count = [&](const GapEnd& end, bool is_doubled) {
      if (end.junction != kNone && is_doubled) odd[end.junction] = !odd[end.junction];
    };
    std::vector<parity::PricedLink> links;
    std::vector<std::size_t> gap_of_link;
    std::vector<GapLayout> others(net_.gaps.size());
    for (std::size_t g = 0; g < net_.gaps.size(); ++g) {
      const Gap& gap = net_.gaps[g];
      const bool is_odd = (gap.lower.size() + gap.upper.size()) % 2 != 0;
      const bool is_dead_end = gap.ends[1].junction == kNone;
      Doubled one{false, is_odd}, two{true, !is_odd};
      if (is_dead_end) one = two = {!is_odd, true};
      GapLayout first = lay_gap(gap, one, region_.points), second;
      if (!is_dead_end) second = lay_gap(gap, two, region_.points);
      work_ += first.work + second.work;
      if (second.cost < first.cost) std::swap(first, second), std::swap(one, two);
      if (!std::isfinite(first.cost)) return false;
      doubled_[g] = one;
      for (int e : {0, 1}) count(gap.ends[e], one[e]);
      if (std::isfinite(second.cost) && gap.ends[0].junction != gap.ends[1].junction) {
        constexpr double kUnit = 1e-6;
        links.push_back({gap.ends[0].junction, gap.ends[1].junction,
                         std::int64_t(std::llround((second.cost - first.cost) / kUnit))});
        gap_of_link.push_back(g);
      }
      layouts_.push_back(std::move(first)), others[g] = std::move(second);
    }
    const parity::Plan plan = parity::plan_cheapest(odd, links);
    if (plan.odd_left.size() != region_.boundary_sides % 2) return false;
    for (Index link : plan.splits) {
      const std::size_t g = gap_of_link[link];
      layouts_[g] = std::move(others[g]);
      for (bool& is_doubled : doubled_[g]) is_doubled = !is_doubled;
    }
    return true;
  }

  bool has_centre(const GapEnd& end) const { return end.junction != kNone && takers_[end.junction] == 3; }

  Index add(const Vec2& p) {
    points_.push_back(p);
    return Index(points_.size() - 1);
  }

  /// The node between the two rows at each end: the far corner of a triangle that is this gap's alone, but for a kite,
  /// else a new one.
  void find_middles() {
    middles_.resize(net_.gaps.size());
    for (std::size_t g = 0; g < net_.gaps.size(); ++g) {
      const Gap& gap = net_.gaps[g];
      for (int e : {0, 1}) {
        const GapEnd& end = gap.ends[e];
        const bool is_shared = e == 1 && is_empty(gap) && has_centre(gap.ends[0]) && has_centre(end);
        if (is_shared)
          middles_[g][1] = middles_[g][0];
        else if (has_centre(end) && doubled_[g][e])
          middles_[g][e] = add((points_[end.lower] + points_[end.upper]) / 2);
        else if (doubled_[g][e] && layouts_[g].has_kite[e])
          middles_[g][e] = add(kite_point(gap, e, region_.points));
        else
          middles_[g][e] = end.beyond;
      }
    }
  }

  void draw_gap(std::size_t g) {
    const Gap& gap = net_.gaps[g];
    const auto& middle = middles_[g];
    if (!layouts_[g].rows) {
      if (doubled_[g][0] && middle[0] != middle[1])
        faces_.push_back({gap.lower[0], middle[1], gap.upper[0], middle[0]});
      return;
    }
    const kernel::Mesh& rows = *layouts_[g].rows;
    std::vector<Index> node = layouts_[g].nodes;
    for (int e : {0, 1})
      if (doubled_[g][e] && gap.ends[e].junction != kNone) {
        node[layouts_[g].middle[e]] = middle[e];
        if (!layouts_[g].has_kite[e] || has_centre(gap.ends[e])) continue;
        const auto [right, left] = side_of(gap, e);
        faces_.push_back({right, middle[e], left, gap.ends[e].beyond});
      }
    for (Index v = Index(node.size()); v < rows.vertex_slots(); ++v) node.push_back(add(rows.point(v)));
    for (Index f = 0; f < rows.face_slots(); ++f) {
      std::array<Index, 4> face{kNone, kNone, kNone, kNone};
      std::size_t i = 0;
      rows.for_nodes_of(f, [&](Index v) { face[i++] = node[v]; });
      faces_.push_back(face);
    }
  }

  /// Three quads around a node where all three gaps have two rows; where none has, the triangle of an odd boundary.
  void draw_junctions() {
    std::vector<std::vector<std::pair<std::size_t, int>>> ends(net_.junctions);
    for (std::size_t g = 0; g < net_.gaps.size(); ++g)
      for (int e : {0, 1})
        if (const Index junction = net_.gaps[g].ends[e].junction; junction != kNone) ends[junction].emplace_back(g, e);
    for (std::size_t j = 0; j < net_.junctions; ++j) {
      const Gap& any = net_.gaps[ends[j][0].first];
      const auto [right, left] = side_of(any, ends[j][0].second);
      const Index beyond = any.ends[ends[j][0].second].beyond;
      if (takers_[j] == 0) faces_.push_back({right, left, beyond, kNone});
      if (takers_[j] != 3) continue;
      const Index centre = add((points_[right] + points_[left] + points_[beyond]) / 3);
      for (const auto& [g, e] : ends[j])
        for (const auto& [h, f] : ends[j]) {
          const Index corner = side_of(net_.gaps[g], e)[0];
          if (corner == side_of(net_.gaps[h], f)[1]) faces_.push_back({corner, middles_[g][e], centre, middles_[h][f]});
        }
    }
  }

  const Region& region_;
  const GapNet net_;
  std::vector<GapLayout> layouts_;             ///< by gap
  std::vector<Doubled> doubled_;               ///< by gap
  std::vector<int> takers_;                    ///< by junction: gaps that have two rows there
  std::vector<std::array<Index, 2>> middles_;  ///< by gap: the nodes between the two rows at its ends
  std::size_t work_ = 0;
  std::vector<Vec2> points_;
  std::vector<std::array<Index, 4>> faces_;
};

}  // namespace

std::optional<kernel::Mesh> lay_gaps(const Region& region) {
  std::optional<GapNet> net = find_gaps(region);
  if (!net) return {};
  return GapLayer(region, std::move(*net)).run();
}

}  // namespace qmorph::bands
