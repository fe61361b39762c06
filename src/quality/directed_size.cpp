// SPDX-License-Identifier: GPL-2.0-or-later
#include "quality/directed_size.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "quality/locate.hpp"
#include "quality/percentile.hpp"

namespace qmorph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Triangle = std::array<Index, 3>;
using Quad = std::array<Index, 4>;

constexpr std::size_t kMostPlaces = 500;

/// The triangles, and two halves of each quad.
std::vector<Triangle> cut(const std::vector<Triangle>& triangles, std::span<const Quad> quads) {
  std::vector<Triangle> all;
  all.reserve(triangles.size() + 2 * quads.size());
  all = triangles;
  for (const auto& [a, b, c, d] : quads) all.insert(all.end(), {{a, b, c}, {a, c, d}});
  return all;
}

/// The mean of a triangle, or of several: their squared lengths, and a vector on the side from which they are seen.
struct Metric {
  Matrix3d squares = Matrix3d::Zero();
  Vector3d normal = Vector3d::Zero();
  double count = 0;

  void add(const Metric& other) { squares += other.squares, normal += other.normal, count += other.count; }
};

Metric metric_of(const std::vector<Vector3d>& points, const Triangle& t) {
  Metric metric{.normal = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]), .count = 1};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d side = points[t[(i + 1) % 3]] - points[t[i]];
    metric.squares += 2.0 / 3 * side * side.transpose();
  }
  return metric;
}

/// An edge in a metric.
struct Measured {
  double length = 0;
  double along = 0;    ///< share of its square in the direction in which triangles are longest
  double stretch = 1;  ///< how much longer they are there than in the other
};

Measured measure(const Vector3d& edge, const Metric& metric) {
  const double length2 = edge.squaredNorm();
  const Vector3d x = edge.normalized(), y = metric.normal.cross(x).normalized();
  const double xx = x.dot(metric.squares * x) / metric.count, yy = y.dot(metric.squares * y) / metric.count;
  const double xy = x.dot(metric.squares * y) / metric.count;
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0 && length2 > 0)) return {};
  const double turn = std::hypot((xx - yy) / 2, xy), largest = (xx + yy) / 2 + turn, smallest = determinant / largest;
  const double share = turn > 0 ? (1 + (xx - yy) / (2 * turn)) / 2 : 1;
  return {std::sqrt(length2 * yy / determinant), share / largest / (share / largest + (1 - share) / smallest),
          std::sqrt(largest / smallest)};
}

/// For each of some triangles the mean of all that have a node in common with it.
std::vector<Metric> look_around(const std::vector<Vector3d>& points, const std::vector<Triangle>& triangles,
                                const std::vector<Index>& chosen) {
  std::vector<Index> number(points.size(), kNone);
  std::vector<Metric> at_node;
  for (Index t : chosen)
    for (Index v : triangles[t])
      if (number[v] == kNone) number[v] = Index(at_node.size()), at_node.emplace_back();
  for (const Triangle& t : triangles) {
    if (std::all_of(t.begin(), t.end(), [&](Index v) { return number[v] == kNone; })) continue;
    const Metric metric = metric_of(points, t);
    for (Index v : t)
      if (number[v] != kNone) at_node[number[v]].add(metric);
  }
  std::vector<Metric> around(chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i)
    for (Index v : triangles[chosen[i]]) around[i].add(at_node[number[v]]);
  return around;
}

/// \param own of the triangle, `around` of those around it
Measured measure(const Vector3d& edge, const Metric& own, const Metric& around) {
  constexpr double kStretched = 2.5;
  const Measured mean = measure(edge, around);
  return mean.stretch > kStretched ? measure(edge, own) : mean;
}

}  // namespace

std::vector<DirectedSize> directed_sizes(const Patch& before, const std::vector<Vector3d>& points,
                                         std::span<const Quad> quads) {
  const std::vector<Triangle> triangles = cut(before.triangles, before.quads);
  std::vector<Index> chosen;
  std::vector<Vector3d> places;
  for (Index t = 0; t < triangles.size(); t += Index(triangles.size() / kMostPlaces + 1)) {
    chosen.push_back(t);
    const auto& [a, b, c] = triangles[t];
    places.push_back((before.points[a] + before.points[b] + before.points[c]) / 3);
  }
  const std::vector<Metric> around = look_around(before.points, triangles, chosen);
  const std::vector<Index> quad_at = locate(places, points, quads);

  std::vector<DirectedSize> sizes;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (quad_at[i] == kNone) continue;
    const auto& [a, b, c, d] = quads[quad_at[i]];
    const Metric own = metric_of(before.points, triangles[chosen[i]]);
    Measured one = measure((points[b] + points[c] - points[a] - points[d]) / 2, own, around[i]);
    Measured two = measure((points[c] + points[d] - points[a] - points[b]) / 2, own, around[i]);
    if (one.length == 0 || two.length == 0) continue;
    if (one.along < two.along) std::swap(one, two);
    sizes.push_back({one.length, two.length});
  }
  return sizes;
}

DirectedSize median(const std::vector<DirectedSize>& sizes) {
  if (sizes.empty()) return {};
  std::vector<double> along, across;
  for (const auto& [a, b] : sizes) along.push_back(a), across.push_back(b);
  return {percentile(along, 50), percentile(across, 50)};
}

double largest_ratio(const DirectedSize& size) {
  return std::max({size.along, 1 / size.along, size.across, 1 / size.across});
}

}  // namespace qmorph
