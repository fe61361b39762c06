// SPDX-License-Identifier: GPL-2.0-or-later
#include "stretch/metric_field.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace qmorph::stretch {

using Eigen::Vector3d;

MetricField::MetricField(const space::Background& surface) : surface_(surface), nodes_(surface.points().size()) {
  constexpr int kPasses = 3;  // noise of a mesh that was jittered hides that it is stretched alike everywhere
  add_axes();
  add_metrics();
  for (int pass = 0; pass < kPasses; ++pass) smooth();
}

MetricField::MetricField(const space::Background& surface, const std::vector<LogMetric>& metrics)
    : surface_(surface), nodes_(surface.points().size()) {
  add_axes();
  for (Index t = 0; t < surface.triangles(); ++t)
    for (Index v : surface.corners(t)) nodes_[v].metric = metrics[v], ++nodes_[v].triangles;
}

/// In a coordinate plane the axes are those of the coordinates.
void MetricField::add_axes() {
  for (Index t = 0; t < surface_.triangles(); ++t)
    for (int i = 0; i < 3; ++i) {
      Node& node = nodes_[surface_.corners(t)[std::size_t(i)]];
      if (node.axis_u.squaredNorm() > 0) continue;
      const Vector3d& normal = surface_.corner_normal(t, i);
      Eigen::Index dominant = 0;
      normal.cwiseAbs().maxCoeff(&dominant);
      const Vector3d along = Vector3d::Unit((dominant + 1) % 3);
      node.axis_u = (along - along.dot(normal) * normal).normalized();
      node.axis_v = normal.cross(node.axis_u);
    }
}

void MetricField::add_metrics() {
  for (Index t = 0; t < surface_.triangles(); ++t) {
    const Vector3d &a = surface_.corner(t, 0), &b = surface_.corner(t, 1), &c = surface_.corner(t, 2);
    for (Index v : surface_.corners(t)) {
      Node& node = nodes_[v];
      const auto in_plane = [&](const Vector3d& side) { return Vec2(side.dot(node.axis_u), side.dot(node.axis_v)); };
      const auto metric = metric_of(in_plane(b - a), in_plane(c - b), in_plane(a - c));
      if (metric) node.metric += *metric;
      ++node.triangles;
    }
  }
  for (Node& node : nodes_)
    if (node.triangles > 0) node.metric = node.metric * (1 / node.triangles);
}

LogMetric MetricField::seen_from(const Node& a, const Node& b) {
  const double angle = std::atan2(b.axis_u.dot(a.axis_v), b.axis_u.dot(a.axis_u));
  return {b.metric.scale, angle == 0 ? b.metric.turn : rotated(b.metric.turn, 2 * angle)};
}

LogMetric MetricField::seen(Index triangle, const Vector3d& weights, const Vector3d& axis_u,
                            const Vector3d& axis_v) const {
  Node here;
  here.axis_u = axis_u, here.axis_v = axis_v;
  LogMetric sum;
  for (int i = 0; i < 3; ++i) sum += seen_from(here, nodes_[surface_.corners(triangle)[std::size_t(i)]]) * weights[i];
  return sum;
}

/// To the mean over the triangles around each node.
void MetricField::smooth() {
  std::vector<LogMetric> sums(nodes_.size());
  for (Index t = 0; t < surface_.triangles(); ++t)
    for (Index v : surface_.corners(t))
      for (Index u : surface_.corners(t)) sums[v] += seen_from(nodes_[v], nodes_[u]);
  for (Index v = 0; v < nodes_.size(); ++v)
    if (nodes_[v].triangles > 0) nodes_[v].metric = sums[v] * (1 / (3 * nodes_[v].triangles));
}

/// By the mean of the two metrics.
double MetricField::length(Index from, Index to) const {
  if (from > to) std::swap(from, to);
  const Node &a = nodes_[from], &b = nodes_[to];
  LogMetric mean = a.metric;
  mean += seen_from(a, b);
  // An edge leaves the tangent plane by its bend, which takes nothing of its length.
  const Vector3d edge = surface_.point(to) - surface_.point(from);
  const Vec2 flat(edge.dot(a.axis_u), edge.dot(a.axis_v));
  const double seen2 = flat.squaredNorm();
  return seen2 > 0 ? (mean * 0.5).length(flat) * std::sqrt(edge.squaredNorm() / seen2) : 0;
}

double MetricField::length(const space::Foot& at, const Vector3d& vector) const {
  const double size = vector.norm();
  const Vector3d& normal = surface_.normal(at.triangle);
  const Vector3d along = vector - vector.dot(normal) * normal;
  if (!(along.squaredNorm() > 0)) return 0;
  const Vector3d axis = along.normalized();
  return seen(at.triangle, at.weights, axis, normal.cross(axis)).length(Vec2(size, 0));
}

std::vector<double> MetricField::side_lengths() const {
  std::vector<double> lengths(3 * surface_.triangles(), 0);
  for (Index side = 0; side < lengths.size(); ++side) {
    const auto& corners = surface_.corners(side / 3);
    lengths[side] = length(corners[side % 3], corners[(side + 1) % 3]);
  }
  return lengths;
}

double MetricField::share_above(double ratio) const {
  const double least = std::log(ratio);
  std::size_t all = 0, above = 0;
  for (const Node& node : nodes_) {
    if (node.triangles == 0) continue;
    ++all;
    above += node.metric.turn.norm() > least;
  }
  return all > 0 ? double(above) / double(all) : 0;
}

double MetricField::largest_ratio() const {
  double largest = 1;
  for (const Node& node : nodes_) largest = std::max(largest, node.metric.ratio());
  return largest;
}

std::optional<LogMetric> MetricField::uniform() const {
  constexpr double kMostSpread = 1.3;  // a factor, in the mean
  LogMetric mean;
  double count = 0;
  const Node* first = nullptr;
  for (const Node& node : nodes_) {
    if (node.triangles == 0) continue;
    if (!first) first = &node;
    if (node.axis_u != first->axis_u || node.axis_v != first->axis_v) return {};
    mean += node.metric;
    ++count;
  }
  mean = mean * (1 / count);
  double spread = 0;
  for (const Node& node : nodes_)
    if (node.triangles > 0) spread += (node.metric.turn - mean.turn).norm();
  if (!(spread <= std::log(kMostSpread) * count)) return {};
  mean.scale = 0;
  return mean;
}

bool has_inside(std::size_t triangles, std::size_t nodes, std::size_t outer) {
  constexpr std::size_t kFewest = 100;  // triangles
  constexpr double kLeast = 0.25;       // of all nodes
  return triangles >= kFewest && double(nodes) - double(outer) >= kLeast * double(nodes);
}

bool may_be_stretched(const space::Background& surface) {
  std::size_t count = 0;
  for (Index t = 0; t < surface.triangles(); ++t) {
    const Vector3d ab = surface.corner(t, 1) - surface.corner(t, 0), bc = surface.corner(t, 2) - surface.corner(t, 1),
                   ca = surface.corner(t, 0) - surface.corner(t, 2);
    count += is_stretched_by(kStretched, ab.squaredNorm() + bc.squaredNorm() + ca.squaredNorm(), ab.cross(bc).norm());
  }
  return double(count) >= kStretchedShare * double(surface.triangles());
}

}  // namespace qmorph::stretch
