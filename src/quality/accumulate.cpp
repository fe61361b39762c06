// SPDX-License-Identifier: GPL-2.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "qmorph/patch.hpp"
#include "qmorph/quality.hpp"
#include "quality/judged.hpp"
#include "quality/percentile.hpp"
#include "quality/shapes.hpp"
#include "quality/valence.hpp"

namespace qmorph {

using Eigen::Vector3d;

namespace {

/// Adds the interior angles of all elements to the angle of each node. A node at which two parts of the surface touch
/// gets the sum of both parts, as it gets the edges of both. Reflex corners, which no valid element has, count as 360 -
/// angle.
template <std::size_t N>
void add_corner_angles(std::span<const Vector3d> points, std::span<const std::array<Index, N>> elements,
                       const std::vector<std::uint8_t>& wanted, std::vector<double>& angles) {
  for (const auto& nodes : elements)
    for (std::size_t i = 0; i < N; ++i) {
      if (!wanted[nodes[i]]) continue;
      const Vector3d ahead = points[nodes[(i + 1) % N]] - points[nodes[i]];
      const Vector3d behind = points[nodes[(i + N - 1) % N]] - points[nodes[i]];
      angles[nodes[i]] += std::atan2(ahead.cross(behind).norm(), ahead.dot(behind));
    }
}

void count_valences(std::span<const Vector3d> points, std::span<const std::array<Index, 3>> triangles,
                    std::span<const std::array<Index, 4>> quads, Quality& counts) {
  const NodeDegrees degrees = node_degrees(points.size(), triangles, quads);
  std::vector<double> angles(points.size(), 0);
  add_corner_angles(points, triangles, degrees.boundary, angles);
  add_corner_angles(points, quads, degrees.boundary, angles);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int edges = degrees.edges[i];
    if (edges == 0) continue;
    if (degrees.boundary[i]) {
      ++counts.boundary_valence[boundary_valence(edges, angles[i] * 180 / std::numbers::pi)];
    } else {
      ++counts.interior_nodes;
      ++counts.valence[edges];
      if (edges != 4) ++counts.irregular_nodes;
    }
  }
}

}  // namespace

double percentile(std::vector<double>& values, double percent) {
  const double rank = percent / 100 * double(values.size() - 1);
  const auto below = std::size_t(rank);
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(below), values.end());
  const double low = values[below];
  if (below + 1 == values.size()) return low;
  const double high = *std::min_element(values.begin() + std::ptrdiff_t(below) + 1, values.end());
  return std::lerp(low, high, rank - double(below));
}

void QualityAccumulator::add_elements(std::span<const Vector3d> points, std::span<const std::array<Index, 3>> triangles,
                                      std::span<const std::array<Index, 4>> quads, const Shapes& shapes) {
  for (Index t = 0; t < triangles.size(); ++t) {
    const ElementShape shape = shapes.triangle(t);
    if (!(shape.scaled_jacobian > 0)) ++counts_.inverted;
    counts_.triangle_metric_min = std::min(counts_.triangle_metric_min, shape.thesis_metric);
    triangle_sum_ += shape.thesis_metric;
  }
  scaled_jacobians_.reserve(scaled_jacobians_.size() + quads.size());
  for (Index q = 0; q < quads.size(); ++q) {
    const ElementShape shape = shapes.quad(q);
    if (!(shape.scaled_jacobian > 0)) ++counts_.inverted;
    scaled_jacobians_.push_back(shape.scaled_jacobian);
    const bool first = scaled_jacobians_.size() == 1;
    const double smallest = shape.smallest_angle_deg, largest = shape.largest_angle_deg;
    counts_.angle_min_deg = first ? smallest : std::min(counts_.angle_min_deg, smallest);
    counts_.angle_max_deg = first ? largest : std::max(counts_.angle_max_deg, largest);
    counts_.eta_min = std::min(counts_.eta_min, shape.eta);
    counts_.thesis_min = std::min(counts_.thesis_min, shape.thesis_metric);
    eta_sum_ += shape.eta;
    thesis_sum_ += shape.thesis_metric;
  }
  counts_.quads += quads.size();
  counts_.triangles += triangles.size();
  count_valences(points, triangles, quads, counts_);
}

void QualityAccumulator::add(std::span<const Vector3d> points, std::span<const std::array<Index, 3>> triangles,
                             std::span<const std::array<Index, 4>> quads, const Vector3d& normal) {
  add_elements(points, triangles, quads, Shapes({points, triangles, quads}, normal));
}

void QualityAccumulator::add(std::span<const Vector3d> points, std::span<const std::array<Index, 3>> triangles,
                             std::span<const std::array<Index, 4>> quads) {
  add_elements(points, triangles, quads, Shapes({points, triangles, quads}));
}

void QualityAccumulator::add(const Patch& before, const QuadMesh& after) { Judged(before, after).add_to(*this); }

void Judged::add_to(QualityAccumulator& figures) {
  figures.add_elements(after().points, after().triangles, after().quads, Shapes(*this));
}

void QualityAccumulator::add(const QualityAccumulator& other) {
  const Quality& theirs = other.counts_;
  const bool first = scaled_jacobians_.empty();
  if (!other.scaled_jacobians_.empty()) {
    counts_.angle_min_deg = first ? theirs.angle_min_deg : std::min(counts_.angle_min_deg, theirs.angle_min_deg);
    counts_.angle_max_deg = first ? theirs.angle_max_deg : std::max(counts_.angle_max_deg, theirs.angle_max_deg);
  }
  counts_.quads += theirs.quads;
  counts_.triangles += theirs.triangles;
  counts_.inverted += theirs.inverted;
  counts_.eta_min = std::min(counts_.eta_min, theirs.eta_min);
  counts_.thesis_min = std::min(counts_.thesis_min, theirs.thesis_min);
  counts_.triangle_metric_min = std::min(counts_.triangle_metric_min, theirs.triangle_metric_min);
  counts_.interior_nodes += theirs.interior_nodes;
  counts_.irregular_nodes += theirs.irregular_nodes;
  for (const auto& [valence, count] : theirs.valence) counts_.valence[valence] += count;
  for (const auto& [valence, count] : theirs.boundary_valence) counts_.boundary_valence[valence] += count;
  scaled_jacobians_.insert(scaled_jacobians_.end(), other.scaled_jacobians_.begin(), other.scaled_jacobians_.end());
  eta_sum_ += other.eta_sum_;
  thesis_sum_ += other.thesis_sum_;
  triangle_sum_ += other.triangle_sum_;
}

Quality QualityAccumulator::result() const {
  Quality quality = counts_;
  if (quality.triangles) quality.triangle_metric_mean = triangle_sum_ / double(quality.triangles);
  if (scaled_jacobians_.empty()) return quality;
  const double count = double(scaled_jacobians_.size());
  double sum = 0;
  std::size_t below = 0;
  for (const double jacobian : scaled_jacobians_) {
    sum += jacobian;
    below += jacobian < 0.3;
  }
  std::vector<double> sorted = scaled_jacobians_;
  quality.scaled_jacobian_min = *std::min_element(sorted.begin(), sorted.end());
  quality.scaled_jacobian_p1 = percentile(sorted, 1);
  quality.scaled_jacobian_p5 = percentile(sorted, 5);
  quality.scaled_jacobian_mean = sum / count;
  quality.scaled_jacobian_below_03 = double(below) / count;
  quality.eta_mean = eta_sum_ / count;
  quality.thesis_mean = thesis_sum_ / count;
  return quality;
}

Quality measure(const QuadMesh& mesh, const Vector3d& normal) {
  QualityAccumulator accumulator;
  accumulator.add(mesh.points, mesh.triangles, mesh.quads, normal);
  return accumulator.result();
}

Quality measure(const QuadMesh& mesh) {
  QualityAccumulator accumulator;
  accumulator.add(mesh.points, mesh.triangles, mesh.quads);
  return accumulator.result();
}

}  // namespace qmorph
