// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/find_band.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/worth.hpp"
#include "kernel/loops.hpp"

namespace qmorph::bands {
namespace {

/// A corner of a strip is sharper.
constexpr double kCornerAngle = 0.75 * std::numbers::pi;
/// One side may have so many times the edges of the other.
constexpr std::size_t kLargestRatio = 4;

double length(const Loop& nodes, const std::vector<Vec2>& points) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) sum += (points[nodes[i + 1]] - points[nodes[i]]).norm();
  return sum;
}

bool has_fair_sides(const Band& band, const BandLimits& limits) {
  return band.upper.size() > limits.least_edges && band.lower.size() <= kLargestRatio * band.upper.size();
}

std::optional<Band> ring(Loop one, Loop other, const BandLimits& limits) {
  Band band;
  band.is_ring = true;
  std::reverse(other.begin(), other.end());
  one.push_back(one.front());
  other.push_back(other.front());
  band.lower = std::move(one), band.upper = std::move(other);
  put_longer_below(band);
  if (!has_fair_sides(band, limits)) return {};
  return band;
}

/// Places in the loop.
std::vector<std::size_t> corners_of(const Loop& loop, const std::vector<Vec2>& points, const BandLimits& limits) {
  std::vector<std::pair<double, std::size_t>> nodes;
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 at = points[loop[i]];
    const double angle = ccw_angle(points[loop[(i + 1) % n]] - at, points[loop[(i + n - 1) % n]] - at);
    if (limits.may_have_any_ends || angle < kCornerAngle) nodes.emplace_back(angle, i);
  }
  if (limits.may_have_any_ends && n > 4) {
    std::sort(nodes.begin(), nodes.end());
    nodes.resize(4);
  }
  std::vector<std::size_t> corners;
  for (const auto& node : nodes) corners.push_back(node.second);
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// A strip has four corners, two of them at each end.
std::optional<Band> strip(const Loop& loop, const std::vector<Vec2>& points, const BandLimits& limits) {
  const std::vector<std::size_t> corners = corners_of(loop, points, limits);
  const std::size_t n = loop.size();
  if (corners.size() != 4) return {};
  std::array<Loop, 4> sides;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = corners[k];; i = (i + 1) % n) {
      sides[k].push_back(loop[i]);
      if (i == corners[(k + 1) % 4] && sides[k].size() > 1) break;
    }
  if (length(sides[0], points) + length(sides[2], points) < length(sides[1], points) + length(sides[3], points))
    std::rotate(sides.begin(), sides.begin() + 1, sides.end());
  Band band;
  band.lower = sides[0], band.end = sides[1], band.upper = sides[2], band.start = sides[3];
  std::reverse(band.upper.begin(), band.upper.end());
  std::reverse(band.start.begin(), band.start.end());
  put_longer_below(band);
  constexpr std::size_t kMostNodes = std::size_t(kMostRows) + 1;
  if (!has_fair_sides(band, limits) || band.start.size() > kMostNodes || band.end.size() > kMostNodes) return {};
  return band;
}

/// Around a ring, a node after the other, is a walk that may go on for ever.
class Side {
 public:
  Side(const Band& band, const std::vector<Vec2>& points) : nodes_(band.upper), points_(points), ring_(band.is_ring) {}
  bool has(std::size_t j) const { return ring_ || j < nodes_.size(); }
  Vec2 point(std::size_t j) const { return points_[nodes_[ring_ ? j % (nodes_.size() - 1) : j]]; }

 private:
  const Loop& nodes_;
  const std::vector<Vec2>& points_;
  bool ring_;
};

}  // namespace

void put_longer_below(Band& band) {
  if (band.lower.size() >= band.upper.size()) return;
  std::swap(band.lower, band.upper);
  std::reverse(band.lower.begin(), band.lower.end());
  std::reverse(band.upper.begin(), band.upper.end());
  std::swap(band.start, band.end);
  std::reverse(band.start.begin(), band.start.end());
  std::reverse(band.end.begin(), band.end.end());
}

std::vector<Index> renumber(Band& band) {
  std::vector<Index> nodes;
  const auto take = [&](Index& v) {
    const bool is_first = !nodes.empty() && v == nodes.front();
    if (!is_first && (nodes.empty() || v != nodes.back())) nodes.push_back(v);
    v = is_first ? 0 : Index(nodes.size() - 1);
  };
  std::for_each(band.lower.begin(), band.lower.end(), take);
  std::for_each(band.end.begin(), band.end.end(), take);
  std::for_each(band.upper.rbegin(), band.upper.rend(), take);
  std::for_each(band.start.rbegin(), band.start.rend(), take);
  return nodes;
}

std::vector<Loop> boundary_of(const Region& region) {
  std::vector<Index> after(region.points.size(), kNone);
  for (std::size_t side = 0; side < region.open.size(); ++side)
    if (region.open[side]) {
      const auto& n = region.triangles[side / 3];
      after[n[side % 3]] = n[(side + 1) % 3];
    }
  return kernel::follow_loops(std::move(after));
}

std::optional<Band> find_band(const Region& region, const BandLimits& limits) {
  const std::vector<Loop> loops = boundary_of(region);
  if (loops.empty() || loops.size() > 2) return {};
  std::size_t nodes = 0;
  for (const Loop& loop : loops) nodes += loop.size();
  if (nodes != region.boundary_sides) return {};  // loops that touch
  std::vector<bool> on_boundary(region.points.size(), false);
  for (const Loop& loop : loops)
    for (Index v : loop) on_boundary[v] = true;
  for (Index v : region.fixed)
    if (!on_boundary[v]) return {};
  std::optional<Band> band =
      loops.size() == 2 ? ring(loops[0], loops[1], limits) : strip(loops[0], region.points, limits);
  if (band)
    band->rows = std::max(1.0, 2 / kTrianglesPerQuad * double(region.triangles.size()) / double(region.boundary_sides));
  return band;
}

std::optional<Facing> find_facing(Band& band, const std::vector<Vec2>& points, double largest_gap) {
  const Vec2 first = points[band.lower.front()];
  if (band.is_ring) {
    band.upper.pop_back();
    const auto distance = [&](Index v) { return (points[v] - first).squaredNorm(); };
    const auto nearest = std::min_element(band.upper.begin(), band.upper.end(),
                                          [&](Index a, Index b) { return distance(a) < distance(b); });
    std::rotate(band.upper.begin(), nearest, band.upper.end());
    band.upper.push_back(band.upper.front());
  }
  const Side upper(band, points);
  const double edge =
      (length(band.lower, points) + length(band.upper, points)) / double(band.lower.size() + band.upper.size() - 2);
  Facing facing;
  double sum = 0;
  std::size_t j = 0;
  for (std::size_t i = 0; i < band.lower.size(); ++i) {
    const Vec2 at = points[band.lower[i]];
    constexpr std::size_t kFarthest = 4;
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = j;
    for (std::size_t k = j; k <= j + kFarthest && upper.has(k); ++k) {
      const double distance = (upper.point(k) - at).norm();
      if (distance < least) least = distance, best = k;
    }
    j = best;
    facing.node.push_back(Index(j));
    facing.rows.push_back(least);
    sum += least;
    if (least > largest_gap * edge) return {};
  }
  // As high as edges are long, but no lower than the triangles.
  const double scale = std::min(1 / edge, band.rows * double(facing.rows.size()) / sum);
  for (double& rows : facing.rows) rows *= scale;
  return facing;
}

}  // namespace qmorph::bands
