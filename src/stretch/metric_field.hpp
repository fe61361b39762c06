// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How the triangles of a surface are stretched, smoothed.

#include <optional>
#include <vector>

#include "space/background.hpp"
#include "stretch/log_metric.hpp"

namespace qmorph::stretch {

/// Where nodes are stretched by more than that, triangles are stretched; as many of all make a surface stretched.
inline constexpr double kStretched = 3, kStretchedShare = 0.2;

/// At each node the mean of the metrics of its triangles, in its tangent plane: a single triangle says little, since a
/// half of a square is stretched, too. In between it varies as the nodes' logarithms do. The surface must outlive it.
class MetricField {
 public:
  explicit MetricField(const space::Background& surface);
  /// With metrics that are known, by row of the surface's points. Its triangles lie in the plane z = 0.
  MetricField(const space::Background& surface, const std::vector<LogMetric>& metrics);

  const LogMetric& at(Index node) const { return nodes_[node].metric; }
  /// Length of the edge between two nodes; the same both ways.
  double length(Index from, Index to) const;
  /// Length of a short vector at a point of a triangle.
  double length(const space::Foot& at, const Eigen::Vector3d& vector) const;
  /// The lengths of all sides of the surface.
  std::vector<double> side_lengths() const;
  /// The metric at the point of a triangle with these weights, by axes of the tangent plane there.
  LogMetric seen(Index triangle, const Eigen::Vector3d& weights, const Eigen::Vector3d& axis_u,
                 const Eigen::Vector3d& axis_v) const;
  /// Share of the nodes at which the ratio is larger than this.
  double share_above(double ratio) const;
  bool is_stretched() const { return share_above(kStretched) >= kStretchedShare; }
  double largest_ratio() const;
  /// Where tangent planes are one plane and ratio and direction are nearly the same everywhere: their mean, which
  /// leaves areas as they are.
  std::optional<LogMetric> uniform() const;

 private:
  struct Node {
    Eigen::Vector3d axis_u = Eigen::Vector3d::Zero(), axis_v = Eigen::Vector3d::Zero();
    LogMetric metric;
    double triangles = 0;
  };
  void add_axes();
  void add_metrics();
  void smooth();
  /// The metric of b with the axes of a.
  static LogMetric seen_from(const Node& a, const Node& b);

  const space::Background& surface_;
  std::vector<Node> nodes_;
};

/// A look at single triangles: whether as many are so long that the surface may be stretched.
bool may_be_stretched(const space::Background& surface);

/// Enough triangles, and enough nodes inside, for the stretch to be the triangles' own: those between two curves, or
/// around one node, are long because there is nothing else to join. `outer` of the nodes lie where the surface ends.
bool has_inside(std::size_t triangles, std::size_t nodes, std::size_t outer);

}  // namespace qmorph::stretch
