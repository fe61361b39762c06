// SPDX-License-Identifier: GPL-2.0-or-later
#include "quality/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/predicates.hpp"
#include "quality/judged.hpp"
#include "space/faults.hpp"
#include "space/mesh_normals.hpp"

namespace qmorph {
namespace {

using Eigen::Vector3d;
using space::Corners;

/// Elements are flat if this share of their area vectors is along the mean normal.
constexpr double kFlatNormals = 1 - 1e-9;

template <std::size_t N>
Corners<N> corners_of(std::span<const Vector3d> points, const std::array<Index, N>& nodes) {
  Corners<N> corners;
  for (std::size_t i = 0; i < N; ++i) corners[i] = points[nodes[i]];
  return corners;
}

template <std::size_t N>
Vector3d area_vector(const Corners<N>& p) {
  if constexpr (N == 3) return (p[1] - p[0]).cross(p[2] - p[0]);
  return (p[2] - p[0]).cross(p[3 % N] - p[1]);
}

std::vector<Vector3d> area_vectors(const SurfaceElements& mesh) {
  std::vector<Vector3d> areas;
  areas.reserve(mesh.triangles.size() + mesh.quads.size());
  for (const auto& nodes : mesh.triangles) areas.push_back(area_vector(corners_of(mesh.points, nodes)));
  for (const auto& nodes : mesh.quads) areas.push_back(area_vector(corners_of(mesh.points, nodes)));
  return areas;
}

}  // namespace

std::optional<Vector3d> common_normal(const SurfaceElements& mesh) {
  const std::vector<Vector3d> areas = area_vectors(mesh);
  Vector3d total = Vector3d::Zero(), normal = Vector3d::UnitZ();
  for (const Vector3d& area : areas) total += area;
  if (total.norm() > 0) normal = total.normalized();
  double lengths = 0, along = 0;  // an upside-down element of a plane is along its normal all the same
  for (const Vector3d& area : areas) {
    lengths += area.norm();
    along += std::abs(area.dot(normal));
  }
  if (along >= kFlatNormals * lengths) return normal;
  return std::nullopt;
}

std::optional<Vector3d> plane_normal(const Patch& patch) {
  Vector3d area = Vector3d::Zero();
  Eigen::AlignedBox3d box;
  const auto add = [&](const auto& nodes) {
    const auto corners = corners_of(patch.points, nodes);
    area += area_vector(corners);
    for (const Vector3d& p : corners) box.extend(p);
  };
  for (const auto& nodes : patch.triangles) add(nodes);
  for (const auto& nodes : patch.quads) add(nodes);
  if (!(area.norm() > 0)) return std::nullopt;
  const Vector3d normal = area.normalized();
  // find_plane() measures from another point, perhaps: what it takes for a plane must be one here.
  const double tolerance = 2 * kPlanarTolerance * box.diagonal().norm();
  const Vector3d& first = patch.points[patch.triangles.empty() ? patch.quads[0][0] : patch.triangles[0][0]];
  const auto lies_outside = [&](const Vector3d& p) { return std::abs((p - first).dot(normal)) > tolerance; };
  if (std::any_of(patch.points.begin(), patch.points.end(), lies_outside)) return std::nullopt;
  return normal;
}

/// Normals of the corners of elements in space, by the surface that they came from, or by the elements around if there
/// is none or its own elements are bad there.
class Shapes::InSpace {
 public:
  explicit InSpace(const SurfaceElements& mesh)
      : sides_(std::in_place, mesh.points.size(), mesh.triangles, mesh.quads),
        by_mesh_(std::in_place, mesh.points, *sides_) {}

  explicit InSpace(Judged& judged) : result_(&judged.on_surface()), unsure_(space::unsure_ground(judged.before())) {
    if (unsure_.empty()) return;
    const QuadMesh& after = judged.after();
    sides_.emplace(after.points.size(), after.triangles, after.quads);
    by_mesh_.emplace(after.points, *sides_);
  }

  template <std::size_t N>
  std::array<double, N> sines(Index element, const Corners<N>& p, const std::array<Index, N>& nodes) const {
    const bool asks_mesh = !result_ || space::is_on_unsure_ground(*result_, element, p, unsure_);
    if (!asks_mesh) return result_->sines(element, p, nodes);
    std::array<double, N> sines = space::corner_sines(p, by_mesh_->of<N>(element));
    if constexpr (N == 4)
      if (double& least = *std::min_element(sines.begin(), sines.end()); space::crosses_itself(p))
        least = -std::abs(least);
    return sines;
  }

 private:
  std::optional<space::ElementSides> sides_;
  std::optional<space::MeshNormals> by_mesh_;
  const space::Result* result_ = nullptr;
  std::vector<char> unsure_;  ///< space::unsure_ground(), if any is
};

Shapes::Shapes(const SurfaceElements& mesh, const Vector3d& normal) : mesh_(mesh), normal_(normal) {}

Shapes::Shapes(const SurfaceElements& mesh) : mesh_(mesh) {
  if (const auto normal = common_normal(mesh))
    normal_ = *normal;
  else
    in_space_ = std::make_unique<const InSpace>(mesh);
}

Shapes::Shapes(Judged& judged) : mesh_{judged.after().points, judged.after().triangles, judged.after().quads} {
  if (judged.plane())
    normal_ = *judged.plane();
  else
    in_space_ = std::make_unique<const InSpace>(judged);
}

Shapes::~Shapes() = default;
Shapes::Shapes(Shapes&&) noexcept = default;

template <std::size_t N>
ElementShape Shapes::shape(Index element, const std::array<Index, N>& nodes) const {
  const Corners<N> p = corners_of(mesh_.points, nodes);
  ElementShape shape;
  std::array<double, N> angles;
  Vector3d normal = normal_;
  if (in_space_) {
    const std::array<double, N> sines = in_space_->sines(element, p, nodes);
    shape.scaled_jacobian = *std::min_element(sines.begin(), sines.end());
    angles = space::corner_angles_deg(p, sines);
    normal = space::element_normal(p);
    // Turned over if most corners are.
    if (std::count_if(sines.begin(), sines.end(), [](double sine) { return sine < 0; }) > long(N) / 2) normal = -normal;
  } else {
    shape.scaled_jacobian = scaled_jacobian(p, normal);
    if constexpr (N == 4) angles = corner_angles_deg(p, normal);
  }
  shape.thesis_metric = thesis_metric(p, normal);
  if constexpr (N == 4) {
    const auto [smallest, largest] = std::minmax_element(angles.begin(), angles.end());
    shape.smallest_angle_deg = *smallest, shape.largest_angle_deg = *largest;
    shape.eta = std::max(0.0, 1 - std::max(90 - *smallest, *largest - 90) / 90);
  }
  return shape;
}

template ElementShape Shapes::shape(Index, const std::array<Index, 3>&) const;
template ElementShape Shapes::shape(Index, const std::array<Index, 4>&) const;

}  // namespace qmorph
