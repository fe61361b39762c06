// SPDX-License-Identifier: GPL-2.0-or-later
#include "stretch/window.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <utility>

namespace qmorph::stretch {
namespace {

using Eigen::Vector3d;

/// Directions of a triangle in space that are the axes of a chart; nothing if it has no area.
struct Axes {
  Vector3d u = Vector3d::Zero(), v = Vector3d::Zero();

  Axes(const chart::LaidOut& window, Index half) {
    const auto& [a, b, c] = window.piece.halves[half];
    const std::vector<Vec2>& flat = window.chart.flat();
    const std::vector<Vector3d>& points = window.piece.points;
    Eigen::Matrix2d in_chart;
    in_chart << flat[b] - flat[a], flat[c] - flat[a];
    Eigen::Matrix<double, 3, 2> in_space;
    in_space << points[b] - points[a], points[c] - points[a];
    const Vector3d normal = in_space.col(0).cross(in_space.col(1));
    if (!(in_chart.determinant() > 0) || !(normal.squaredNorm() > 0)) return;
    u = (in_space * in_chart.inverse().col(0)).normalized();
    v = normal.cross(u).normalized();
  }
};

/// The metric at the window's points, by the axes of its chart.
std::vector<LogMetric> metrics_in(const chart::LaidOut& window, const MetricField& field,
                                  const space::Background& background) {
  const chart::Piece& piece = window.piece;
  std::vector<LogMetric> metrics(piece.points.size());
  std::vector<double> counts(metrics.size(), 0);
  for (Index half = 0; half < piece.halves.size(); ++half) {
    const Axes axes(window, half);
    if (axes.u.isZero()) continue;
    for (Index v : piece.halves[half]) {
      const space::Foot foot = background.foot_on(piece.on[v], piece.points[v]);
      metrics[v] += field.seen(foot.triangle, foot.weights, axes.u, axes.v);
      ++counts[v];
    }
  }
  for (std::size_t v = 0; v < metrics.size(); ++v)
    if (counts[v] > 0) metrics[v] = metrics[v] * (1 / counts[v]);
  return metrics;
}

}  // namespace

StretchedWindow::StretchedWindow(const chart::LaidOut& window, const std::vector<LogMetric>& metrics)
    : window_(window),
      surface_(window.chart.flat(), window.piece.halves, window.piece.barriers()),
      field_(surface_.background, metrics) {}

std::unique_ptr<const StretchedWindow> StretchedWindow::of(const chart::LaidOut& window, const chart::Ground& ground) {
  if (!ground.field) return nullptr;
  std::unique_ptr<StretchedWindow> own(
      new StretchedWindow(window, metrics_in(window, *ground.field, ground.background)));
  if (!own->field_.is_stretched()) return nullptr;
  std::optional<chart::Flattening> flattening = unfold(own->surface_.background, own->field_);
  if (!flattening) return nullptr;
  own->unfolded_.emplace(own->surface_, own->field_, std::move(*flattening));
  return own;
}

bool StretchedWindow::bring_back_straightened(kernel::Mesh& mesh) const {
  unfolded_->lift_and_straighten(mesh);
  return is_valid(mesh, field_);
}

}  // namespace qmorph::stretch
