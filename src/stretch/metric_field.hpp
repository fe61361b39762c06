// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How the triangles of a surface are stretched, smoothed.

#include <optional>
#include <vector>

#include "space/background.hpp"
#include "stretch/log_metric.hpp"

namespace qmorph::stretch {

/// At each node the mean of the metrics of its triangles, in its tangent plane: a single triangle says little, since a
/// half of a square is stretched, too. In between it varies as the nodes' logarithms do. The surface must outlive it.
class MetricField {
 public:
  explicit MetricField(const space::Background& surface);

  const LogMetric& at(Index node) const { return nodes_[node].metric; }
  /// Length of the edge between two nodes; the same both ways.
  double length(Index from, Index to) const;
  /// The lengths of all sides of the surface.
  std::vector<double> side_lengths() const;
  /// Share of the nodes at which the ratio is larger than this.
  double share_above(double ratio) const;
  double largest_ratio() const;
  /// Where tangent planes are one plane and ratio and direction are nearly the same everywhere: their mean, which leaves
  /// areas as they are.
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

}  // namespace qmorph::stretch
