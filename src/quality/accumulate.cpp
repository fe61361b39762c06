#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "qmorph/patch.hpp"
#include "qmorph/quality.hpp"
#include "quality/percentile.hpp"
#include "quality/valence.hpp"

namespace qmorph {

using Eigen::Vector3d;

/// One normal for all elements, or (if `flat` is not set) the one of each element's own area vector.
struct QualityAccumulator::ElementNormals {
  bool flat = true;
  Vector3d common = Vector3d::UnitZ();

  template <std::size_t N>
  Vector3d of(const std::array<Vector3d, N>& p) const {
    if (flat) return common;
    const Vector3d own = area_vector(p);
    const double length = own.norm();
    return length > 0 ? Vector3d(own / length) : common;
  }

  template <std::size_t N>
  static Vector3d area_vector(const std::array<Vector3d, N>& p) {
    if constexpr (N == 3) return (p[1] - p[0]).cross(p[2] - p[0]);
    return (p[2] - p[0]).cross(p[3 % N] - p[1]);
  }
};

namespace {

/// A surface is flat if this share of its elements' area vectors is along the mean normal.
constexpr double kFlatNormals = 1 - 1e-9;

template <std::size_t N>
std::array<Vector3d, N> corners_of(std::span<const Vector3d> points, const std::array<Index, N>& nodes) {
  std::array<Vector3d, N> corners;
  for (std::size_t i = 0; i < N; ++i) corners[i] = points[nodes[i]];
  return corners;
}

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
                                      std::span<const std::array<Index, 4>> quads, const ElementNormals& normals) {
  for (const auto& nodes : triangles) {
    const auto corners = corners_of(points, nodes);
    const Vector3d normal = normals.of(corners);
    if (!(scaled_jacobian(corners, normal) > 0)) ++counts_.inverted;
    const double metric = thesis_metric(corners, normal);
    counts_.triangle_metric_min = std::min(counts_.triangle_metric_min, metric);
    triangle_sum_ += metric;
  }
  scaled_jacobians_.reserve(scaled_jacobians_.size() + quads.size());
  for (const auto& nodes : quads) {
    const auto corners = corners_of(points, nodes);
    const Vector3d normal = normals.of(corners);
    const double jacobian = scaled_jacobian(corners, normal);
    if (!(jacobian > 0)) ++counts_.inverted;
    scaled_jacobians_.push_back(jacobian);

    const auto angles = corner_angles_deg(corners, normal);
    const auto [smallest, largest] = std::minmax_element(angles.begin(), angles.end());
    const double shape = std::max(0.0, 1 - std::max(90 - *smallest, *largest - 90) / 90);
    const double thesis = thesis_metric(corners, normal);
    const bool first = scaled_jacobians_.size() == 1;
    counts_.angle_min_deg = first ? *smallest : std::min(counts_.angle_min_deg, *smallest);
    counts_.angle_max_deg = first ? *largest : std::max(counts_.angle_max_deg, *largest);
    counts_.eta_min = std::min(counts_.eta_min, shape);
    counts_.thesis_min = std::min(counts_.thesis_min, thesis);
    eta_sum_ += shape;
    thesis_sum_ += thesis;
  }
  counts_.quads += quads.size();
  counts_.triangles += triangles.size();
  count_valences(points, triangles, quads, counts_);
}

void QualityAccumulator::add(std::span<const Vector3d> points, std::span<const std::array<Index, 3>> triangles,
                             std::span<const std::array<Index, 4>> quads, const Vector3d& normal) {
  add_elements(points, triangles, quads, {.flat = true, .common = normal});
}

void QualityAccumulator::add(std::span<const Vector3d> points, std::span<const std::array<Index, 3>> triangles,
                             std::span<const std::array<Index, 4>> quads) {
  std::vector<Vector3d> areas;
  areas.reserve(triangles.size() + quads.size());
  for (const auto& nodes : triangles) areas.push_back(ElementNormals::area_vector(corners_of(points, nodes)));
  for (const auto& nodes : quads) areas.push_back(ElementNormals::area_vector(corners_of(points, nodes)));

  Vector3d total = Vector3d::Zero();
  for (const Vector3d& area : areas) total += area;
  ElementNormals normals;
  if (total.norm() > 0) normals.common = total.normalized();
  double lengths = 0,
         along = 0;  // an upside-down element of a plane is along its normal all the same
  for (const Vector3d& area : areas) {
    lengths += area.norm();
    along += std::abs(area.dot(normals.common));
  }
  normals.flat = along >= kFlatNormals * lengths;
  add_elements(points, triangles, quads, normals);
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
