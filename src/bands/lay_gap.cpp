// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/lay_gap.hpp"

#include <algorithm>
#include <utility>

#include "bands/find_band.hpp"
#include "bands/lay_chords.hpp"
#include "bands/lay_rows.hpp"
#include "cleanup/poor_shapes.hpp"

namespace qmorph::bands {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// What a quad costs, besides what it lacks: if it is no rectangle; and that there is one more.
constexpr double kPriceOfLean = 0.1, kPriceOfQuad = 0.2;

double price(double sine) { return cleanup::lack_of(sine) + kPriceOfLean * (1 - sine) + kPriceOfQuad; }

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

}  // namespace

bool is_empty(const Gap& gap) { return gap.lower.size() + gap.upper.size() == 2 && gap.ends[1].junction != kNone; }

std::array<Index, 2> side_of(const Gap& gap, int e) {
  const GapEnd& end = gap.ends[e];
  return e == 0 ? std::array{end.lower, end.upper} : std::array{end.upper, end.lower};
}

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

GapLayout lay_gap(const Gap& gap, const Doubled& doubled, const std::vector<Vec2>& points) {
  GapLayout best;
  std::size_t work = 0;
  if (is_empty(gap)) {
    const auto p = [&](Index v) { return points[v]; };
    const auto& [one, other] = gap.ends;
    best.cost =
        !doubled[0] ? 0 : price(smallest_corner_sine(p(one.lower), p(other.beyond), p(one.upper), p(one.beyond)));
    return best;
  }
  const auto outer = Index(points.size());
  const std::array<Vec2, 2> kites{kite_point(gap, 0, points), kite_point(gap, 1, points)};
  const auto point = [&](Index v) { return v < outer ? points[v] : kites[v - outer]; };
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
      std::vector<Vec2> ring;
      for (Index v : nodes) ring.push_back(point(v));
      for (std::optional<kernel::Mesh>& rows : ways_between(band, ring)) {
        if (!rows) continue;
        work += rows->work();
        const double cost = extra + cost_of(*rows, nodes, outer);
        if (cost < best.cost) best = {std::move(rows), nodes, {Index(nodes.size() - 1), end_middle}, has_kite, cost, 0};
      }
    }
  best.work = work;
  return best;
}

}  // namespace qmorph::bands
