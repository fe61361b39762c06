// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/geometry/node_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gmsh/session/compat.hpp"
#include "kernel/sort_unique.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

std::vector<double> flat(const std::vector<Vector2d>& parameters) {
  std::vector<double> numbers;
  numbers.reserve(2 * parameters.size());
  for (const Vector2d& p : parameters) numbers.insert(numbers.end(), {p.x(), p.y()});
  return numbers;
}

std::vector<Vector2d> pairs(const std::vector<double>& numbers) {
  std::vector<Vector2d> parameters;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) parameters.emplace_back(numbers[i], numbers[i + 1]);
  return parameters;
}

}  // namespace

std::vector<Vector3d> surface_points(int tag, const std::vector<Vector2d>& parameters) {
  std::vector<double> xyz;
  if (!parameters.empty()) ::gmsh::model::getValue(2, tag, flat(parameters), xyz);
  xyz.resize(3 * parameters.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<Vector3d> points;
  points.reserve(parameters.size());
  for (std::size_t i = 0; i < xyz.size(); i += 3) points.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  return points;
}

std::vector<Tangents> surface_tangents(int tag, const std::vector<Vector2d>& parameters) {
  std::vector<double> xyz;
  if (!parameters.empty()) ::gmsh::model::getDerivative(2, tag, flat(parameters), xyz);
  xyz.resize(6 * parameters.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<Tangents> tangents;
  tangents.reserve(parameters.size());
  for (std::size_t i = 0; i < xyz.size(); i += 6)
    tangents.push_back({Vector3d(xyz[i], xyz[i + 1], xyz[i + 2]), Vector3d(xyz[i + 3], xyz[i + 4], xyz[i + 5])});
  return tangents;
}

Vector2d ParameterRange::within(Vector2d p) const {
  for (int i = 0; i < 2; ++i)
    if (!(period[i] > 0)) p[i] = std::clamp(p[i], low[i], high[i]);
  return p;
}

Vector2d ParameterRange::wrapped(Vector2d p) const {
  for (int i = 0; i < 2; ++i)
    if (period[i] > 0) p[i] -= period[i] * std::floor((p[i] - low[i]) / period[i]);
  return p;
}

Vector2d ParameterRange::nearest(Vector2d p, const Vector2d& to) const {
  for (int i = 0; i < 2; ++i)
    if (period[i] > 0) p[i] += period[i] * std::round((to[i] - p[i]) / period[i]);
  return p;
}

NodeParameters::NodeParameters(const ModelMesh& mesh, std::uint32_t entity) : tag_(mesh.entities[entity].tag) {
  std::vector<double> low, high;
  ::gmsh::model::getParametrizationBounds(2, tag_, low, high);
  if (low.size() != 2 || high.size() != 2 || !(low[0] < high[0] && low[1] < high[1])) return;
  range_.low = {low[0], low[1]}, range_.high = {high[0], high[1]};
  find_period();
  add_inside(mesh, mesh.entities[entity]);
  ::gmsh::vectorpair curves, points;
  ::gmsh::model::getBoundary({{2, tag_}}, curves, false, false, false);
  ::gmsh::model::getBoundary({{2, tag_}}, points, false, false, true);
  ::gmsh::vectorpair embedded;
  ::gmsh::model::mesh::getEmbedded(2, tag_, embedded);
  for (const auto& [dim, tag] : embedded) {
    (dim == 1 ? curves : points).emplace_back(dim, tag);
    if (dim == 1) ::gmsh::model::getBoundary({{1, tag}}, points, false, false, true);
  }
  for (::gmsh::vectorpair* list : {&curves, &points}) sort_unique(*list);
  for (const auto& [dim, tag] : curves) add_curve(mesh, tag);
  for (const auto& [dim, tag] : points)
    if (dim == 0) add_point(mesh, tag);
  find_distances(mesh);
  find_poles();
}

/// What is the same on both sides of the range.
void NodeParameters::find_period() {
  constexpr double kSame = 1e-8;  // of the surface's extent
  constexpr int kPlaces = 4;
  const Vector2d size = range_.high - range_.low;
  for (int i = 0; i < 2; ++i) {
    std::vector<Vector2d> places;
    for (int k = 0; k < kPlaces; ++k)
      for (const double side : {0.0, 1.0, 0.5}) {
        Vector2d p = range_.low + size * ((k + 0.5) / kPlaces);
        p[i] = range_.low[i] + side * size[i];
        places.push_back(p);
      }
    const std::vector<Vector3d> points = surface_points(tag_, places);
    double gap = 0, extent = 0;
    for (std::size_t k = 0; k < points.size(); k += 3) {
      gap = std::max(gap, (points[k] - points[k + 1]).norm());
      extent = std::max(extent, (points[k] - points[k + 2]).norm());
    }
    if (gap <= kSame * extent) range_.period[i] = size[i];
  }
}

void NodeParameters::add_inside(const ModelMesh& mesh, const EntityMesh& surface) {
  if (surface.node_tags.empty()) return;
  first_row_ = mesh.rows.find(surface.node_tags.front());
  std::vector<double> found;
  if (surface.uv.empty()) ::gmsh::model::getParametrization(2, tag_, surface.xyz, found);  // a mesh merged onto it
  for (const Vector2d& p : pairs(surface.uv.empty() ? found : surface.uv)) inside_.push_back({p});
  if (inside_.size() != surface.node_tags.size()) inside_.clear();
}

void NodeParameters::add_curve(const ModelMesh& mesh, int curve) {
  if (const EntityMesh* entity = find_entity(mesh, 1, curve); !entity || entity->node_tags.empty()) return;
  std::vector<std::size_t> tags;
  std::vector<double> xyz, t, uv;
  ::gmsh::model::mesh::getNodes(tags, xyz, t, 1, curve, false, true);
  if (t.size() != tags.size()) return;  // no parameters are stored
  for (const int side : {0, 1}) {       // of a seam
    ::gmsh::model::reparametrizeOnSurface(1, curve, t, tag_, uv, side);
    if (uv.size() == 2 * tags.size())
      for (std::size_t i = 0; i < tags.size(); ++i) add(mesh.rows.find(tags[i]), {uv[2 * i], uv[2 * i + 1]});
  }
}

void NodeParameters::add_point(const ModelMesh& mesh, int point) {
  const EntityMesh* entity = find_entity(mesh, 0, point);
  if (!entity || entity->node_tags.size() != 1) return;
  std::vector<double> uv;
  for (const int side : {0, 1}) {
    ::gmsh::model::reparametrizeOnSurface(0, point, {}, tag_, uv, side);
    if (uv.size() == 2) add(mesh.rows.find(entity->node_tags[0]), {uv[0], uv[1]});
  }
}

void NodeParameters::find_distances(const ModelMesh& mesh) {
  std::vector<std::pair<Candidate*, Index>> all;
  for (std::size_t i = 0; i < inside_.size(); ++i) all.emplace_back(&inside_[i], first_row_ + Index(i));
  for (auto& [row, candidates] : beside_)
    for (Candidate& candidate : candidates) all.emplace_back(&candidate, row);
  std::vector<Vector2d> places;
  for (const auto& [candidate, row] : all) places.push_back(candidate->at);
  const std::vector<Vector3d> points = surface_points(tag_, places);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].first->distance = (points[i] - mesh.points[all[i].second]).norm();
}

/// Where a whole side of the range is one point of the surface.
void NodeParameters::find_poles() {
  constexpr double kNoLength = 1e-6;  // of the other derivative's, in sizes of the range
  std::vector<Candidate*> all;
  std::vector<Vector2d> places;
  for (auto& [row, candidates] : beside_)
    for (Candidate& candidate : candidates) all.push_back(&candidate), places.push_back(candidate.at);
  const std::vector<Tangents> tangents = surface_tangents(tag_, places);
  const Vector2d size = range_.high - range_.low;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double u = tangents[i].u.norm() * size.x(), v = tangents[i].v.norm() * size.y();
    all[i]->counts = {!(u <= kNoLength * v), !(v <= kNoLength * u)};
  }
}

}  // namespace qmorph::adapter
