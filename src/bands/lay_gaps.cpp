// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/lay_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "bands/find_band.hpp"
#include "bands/gap_net.hpp"
#include "bands/lay_chords.hpp"
#include "bands/lay_rows.hpp"
#include "parity/plan.hpp"

namespace qmorph::bands {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// What a quad costs: up to which sine it is poor, the more the poorer; what it lacks of
/// a rectangle; and that there is one more.
constexpr double kPoor = 0.6, kPriceOfLean = 0.1, kPriceOfQuad = 0.2;

/// Which ends of a gap have two rows.
using Doubled = std::array<bool, 2>;

/// A gap's rows.
struct Layout {
  std::optional<kernel::Mesh> rows;           ///< none for a gap without triangles
  std::vector<Index> nodes;                   ///< of the region: the first ones of `rows`
  std::array<Index, 2> middle{kNone, kNone};  ///< places among them of those between two rows at the ends
  std::array<bool, 2> has_kite{false, false};
  double cost = kInfinite;
};

double price(double sine) {
  const double lack = std::max(0.0, kPoor - sine) / kPoor;
  return lack * lack + kPriceOfLean * (1 - sine) + kPriceOfQuad;
}

/// `nodes`: the region's, of the first ones of `rows`; of these those under `outer` are on the boundary, and a corner
/// between three of them stays as it is.
double cost_of(const kernel::Mesh& rows, const std::vector<Index>& nodes, Index outer) {
  constexpr double kBlunt = 0.1, kPriceOfBlunt = 10;
  const auto stays = [&](Index v) { return v < nodes.size() && nodes[v] < outer; };
  double sum = 0;
  for (Index f = 0; f < rows.face_slots(); ++f) {
    sum += price(rows.smallest_sine(f));
    for (Index h : rows.sides_of(f)) {
      const Index v = rows.origin(h), next = rows.target(h), previous = rows.origin(rows.prev(h));
      if (stays(v) && stays(next) && stays(previous) &&
          corner_sine(rows.point(v), rows.point(next), rows.point(previous)) < kBlunt)
        sum += kPriceOfBlunt;
    }
  }
  return sum;
}

/// Two triangles share a side there.
bool is_empty(const Gap& gap) { return gap.lower.size() + gap.upper.size() == 2 && gap.ends[1].junction != kNone; }

/// The nodes of an end from the lower side to the upper one, and whether the sides go on to its far corner. With a kite
/// the node between two rows is a new one inside the gap, in the corner of a quad with the junction's three.
struct EndNodes {
  std::vector<Index> nodes;
  bool is_longer_below = false, is_longer_above = false, has_kite = false;
};

/// Of a dead end the far corner is in the middle, or one of either side. `kite`: the number of a kite's new node.
std::vector<EndNodes> ways_to_end(const GapEnd& end, bool is_doubled, Index kite) {
  const std::vector<Index> around{end.lower, end.beyond, end.upper};
  if (end.junction == kNone)
    return {{around}, {{end.beyond, end.upper}, true, false}, {{end.lower, end.beyond}, false, true}};
  if (!is_doubled) return {{{end.lower, end.upper}}};
  return {{around}, {{end.lower, kite, end.upper}, false, false, true}};
}

/// Of a junction and its side towards a gap: the side's nodes in its own sense, the gap on their right.
std::array<Index, 2> side_of(const Gap& gap, int e) {
  const GapEnd& end = gap.ends[e];
  return e == 0 ? std::array{end.lower, end.upper} : std::array{end.upper, end.lower};
}

/// Where a kite's node is at first: as far into the gap as half its width, or half-way to the next nodes.
Vec2 kite_point(const Gap& gap, int e, const std::vector<Vec2>& points) {
  const GapEnd& end = gap.ends[e];
  const Vec2 middle = (points[end.lower] + points[end.upper]) / 2, way = middle - points[end.beyond];
  double depth = (points[end.upper] - points[end.lower]).norm();
  for (const std::vector<Index>* side : {&gap.lower, &gap.upper}) {
    if (side->size() < 2) continue;
    const auto n = side->size();
    depth = std::min(depth, (points[(*side)[e == 0 ? 1 : n - 2]] - points[(*side)[e == 0 ? 0 : n - 1]]).norm());
  }
  return middle + depth / 2 / way.norm() * way;
}

Band band_of(const Gap& gap, const EndNodes& start, const EndNodes& end) {
  Band band;
  band.lower = gap.lower, band.upper = gap.upper;
  if (start.is_longer_below) band.lower.insert(band.lower.begin(), start.nodes.front());
  if (start.is_longer_above) band.upper.insert(band.upper.begin(), start.nodes.back());
  if (end.is_longer_below) band.lower.push_back(end.nodes.front());
  if (end.is_longer_above) band.upper.push_back(end.nodes.back());
  band.start = start.nodes, band.end = end.nodes;
  return band;
}

/// As rows, and where there are none in a short gap with no node inside. `points`: of the band's nodes, once round.
std::array<std::optional<kernel::Mesh>, 3> ways_between(Band band, const std::vector<Vec2>& points) {
  constexpr std::size_t kShort = 14;  // nodes
  std::array<std::optional<kernel::Mesh>, 3> ways;
  put_longer_below(band);
  ways[0] = lay_rows(band, points, kBetterTurns, kInfinite);
  ways[1] = lay_rows(band, points, kFewerTurns, kInfinite);
  if (!ways[0] && !ways[1] && points.size() <= kShort)
    if (const Chords chords = best_chords(points); !chords.faces.empty())
      ways[2] = kernel::Mesh(points, chords.faces, {});
  return ways;
}

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
  /// Best of the ways to lay a gap's rows.
  Layout lay(const Gap& gap, const Doubled& doubled) {
    Layout best;
    if (is_empty(gap)) {
      const auto p = [&](Index v) { return region_.points[v]; };
      const auto& [one, other] = gap.ends;
      best.cost =
          !doubled[0] ? 0 : price(smallest_corner_sine(p(one.lower), p(other.beyond), p(one.upper), p(one.beyond)));
      return best;
    }
    const auto outer = Index(region_.points.size());
    const std::array<Vec2, 2> kites{kite_point(gap, 0, region_.points), kite_point(gap, 1, region_.points)};
    const auto point = [&](Index v) { return v < outer ? region_.points[v] : kites[v - outer]; };
    for (const EndNodes& start : ways_to_end(gap.ends[0], doubled[0], outer))
      for (const EndNodes& end : ways_to_end(gap.ends[1], doubled[1], outer + 1)) {
        Band band = band_of(gap, start, end);
        const std::array<bool, 2> has_kite{start.has_kite, end.has_kite};
        double extra = 0;
        for (int e : {0, 1})
          if (has_kite[e]) {
            const auto [right, left] = side_of(gap, e);
            extra += price(smallest_corner_sine(point(right), kites[e], point(left), point(gap.ends[e].beyond)));
          }
        const auto end_middle = Index(band.lower.size());
        const std::vector<Index> nodes = renumber(band);
        std::vector<Vec2> points;
        for (Index v : nodes) points.push_back(point(v));
        for (std::optional<kernel::Mesh>& rows : ways_between(band, points)) {
          if (!rows) continue;
          work_ += rows->work();
          const double cost = extra + cost_of(*rows, nodes, outer);
          if (cost < best.cost) best = {std::move(rows), nodes, {Index(nodes.size() - 1), end_middle}, has_kite, cost};
        }
      }
    return best;
  }

  /// Decides which ends have two rows. At a junction their number is odd; a gap's is as odd as its sides together, so
  /// that of two ways there are to choose from one changes both its ends.
  bool choose() {
    std::vector<bool> odd(net_.junctions, true);
    const auto count = [&](const GapEnd& end, bool is_doubled) {
      if (end.junction != kNone && is_doubled) odd[end.junction] = !odd[end.junction];
    };
    std::vector<parity::PricedLink> links;
    std::vector<std::size_t> gap_of_link;
    std::vector<Layout> others(net_.gaps.size());
    for (std::size_t g = 0; g < net_.gaps.size(); ++g) {
      const Gap& gap = net_.gaps[g];
      const bool is_odd = (gap.lower.size() + gap.upper.size()) % 2 != 0;
      const bool is_dead_end = gap.ends[1].junction == kNone;
      Doubled one{false, is_odd}, two{true, !is_odd};
      if (is_dead_end) one = two = {!is_odd, true};
      Layout first = lay(gap, one), second = is_dead_end ? Layout() : lay(gap, two);
      if (second.cost < first.cost) std::swap(first, second), std::swap(one, two);
      if (first.cost == kInfinite) return false;
      doubled_[g] = one;
      for (int e : {0, 1}) count(gap.ends[e], one[e]);
      if (second.cost < kInfinite && gap.ends[0].junction != gap.ends[1].junction) {
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
  std::vector<Layout> layouts_;                ///< by gap
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
