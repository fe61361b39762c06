// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/geometry/cad_surface.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "gmsh/session/compat.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

// Lengths are in edges of the triangle that a point is on.
/// A node that lies farther from the point at its parameters does not belong to this geometry.
constexpr double kOnGeometry = 1e-3;
/// If the surface is farther than this from the triangle, it is another part of the surface: a circle's chord that
/// turns by 120 degrees has 0.29.
constexpr double kFarthest = 0.3;
/// A Newton step shorter than that is the last: what it leaves is along the surface, not away from it.
constexpr double kLastStep = 1e-3;
/// Newton steps are cut to this length.
constexpr double kLongestStep = 1;
constexpr int kMostSteps = 8;

/// The step that brings x nearer to p, in parameters; `length` gets how long it is in space.
Vector2d newton_step(const Vector3d& way, const Tangents& along, double& length) {
  // Each parameter in units of length: near a pole one may have nearly none.
  const double u = along.u.norm(), v = along.v.norm();
  const Vector3d a = u > 0 ? Vector3d(along.u / u) : Vector3d::Zero(),
                 b = v > 0 ? Vector3d(along.v / v) : Vector3d::Zero();
  const double ab = a.dot(b), determinant = 1 - ab * ab;
  constexpr double kParallel = 1e-12;
  Vector2d step(way.dot(a), way.dot(b));
  if (determinant > kParallel && u > 0 && v > 0)
    step = Vector2d(step.x() - ab * step.y(), step.y() - ab * step.x()) / determinant;
  length = (step.x() * a + step.y() * b).norm();
  return {u > 0 ? step.x() / u : 0, v > 0 ? step.y() / v : 0};
}

/// A mean by weights, of what counts.
struct Mean {
  Vector2d sum = Vector2d::Zero(), weight = Vector2d::Zero();
  void add(const Vector2d& p, const std::array<bool, 2>& counts, double w) {
    for (int i = 0; i < 2; ++i)
      if (counts[std::size_t(i)]) sum[i] += w * p[i], weight[i] += w;
  }
  double of(int i, double otherwise) const { return weight[i] > 0 ? sum[i] / weight[i] : otherwise; }
};

}  // namespace

bool CadSurface::may_be_found(const ModelMesh& mesh, std::uint32_t entity) {
  const std::string type = entity_type(2, mesh.entities[entity].tag);
  for (const char* no_geometry : {"Discrete", "Partition", "Ghost", "Plane"})
    if (type.rfind(no_geometry, 0) == 0) return false;
  return true;
}

std::unique_ptr<CadSurface> CadSurface::find(const ModelMesh& mesh, std::uint32_t entity) {
  if (!may_be_found(mesh, entity)) return nullptr;
  std::unique_ptr<CadSurface> surface(new CadSurface(mesh, entity));
  return surface->exists() ? std::move(surface) : nullptr;
}

bool CadSurface::exists() const {
  if (parameters_.empty()) return false;
  const Vector2d middle = 0.5 * (parameters_.range().low + parameters_.range().high);
  std::vector<double> normal;
  ::gmsh::model::getNormal(tag_, {middle.x(), middle.y()}, normal);
  return normal.size() == 3 && Vector3d(normal[0], normal[1], normal[2]).norm() > 0.5;
}

double CadSurface::edge(const OnInput& point) const {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sum += (mesh_.points[point.corners[i]] - mesh_.points[point.corners[(i + 1) % 3]]).norm();
  return sum / 3;
}

/// Between the parameters of the corners. False if no corner lies on the surface.
bool CadSurface::guess(const OnInput& point, Vector2d& start) const {
  const double off = kOnGeometry * edge(point);
  // What is inside has one place; the others are on the same side of a seam.
  const Candidate* base = nullptr;
  double weight = 0;
  for (std::size_t i = 0; i < 3; ++i)
    parameters_.for_each(point.corners[i], [&](const Candidate& candidate) {
      if (!(candidate.distance <= off)) return;
      const bool whole = candidate.counts[0] && candidate.counts[1];
      const double w =
          point.weights[Eigen::Index(i)] + (whole ? 1 : 0) + (parameters_.is_inside(point.corners[i]) ? 2 : 0);
      if (w > weight) base = &candidate, weight = w;
    });
  if (!base) return false;
  const ParameterRange& range = parameters_.range();
  const Vector2d size = range.high - range.low;
  Mean mean;
  for (std::size_t i = 0; i < 3; ++i) {
    const Candidate* best = nullptr;
    Vector2d at = Vector2d::Zero();
    double least = 0;
    parameters_.for_each(point.corners[i], [&](const Candidate& candidate) {
      if (!(candidate.distance <= off)) return;
      const Vector2d p = range.nearest(candidate.at, base->at);
      const double distance = (p - base->at).cwiseQuotient(size).squaredNorm();
      if (!best || distance < least) best = &candidate, at = p, least = distance;
    });
    if (best) mean.add(at, best->counts, point.weights[Eigen::Index(i)]);
  }
  start = {mean.of(0, base->at.x()), mean.of(1, base->at.y())};
  return true;
}

std::vector<Landing> CadSurface::land(std::span<const OnInput> points) const {
  std::vector<Landing> landings(points.size());
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < points.size(); ++i) {
    landings[i].point = points[i].point;
    if (guess(points[i], landings[i].parameters)) open.push_back(i);
  }
  search(points, std::move(open), landings);
  return landings;
}

std::vector<Vector3d> CadSurface::normals(std::span<const OnInput> points) const {
  std::vector<Vector3d> normals(points.size(), Vector3d::Zero());
  std::vector<double> parameters, found;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vector2d at = Vector2d::Zero();
    if (!guess(points[i], at)) continue;
    at = parameters_.range().wrapped(at);
    parameters.insert(parameters.end(), {at.x(), at.y()});
    rows.push_back(i);
  }
  if (!rows.empty()) ::gmsh::model::getNormal(tag_, parameters, found);
  if (found.size() != 3 * rows.size()) return normals;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (const Vector3d n(found[3 * k], found[3 * k + 1], found[3 * k + 2]); n.allFinite()) normals[rows[k]] = n;
  return normals;
}

void CadSurface::search(std::span<const OnInput> points, std::vector<std::size_t> open,
                        std::vector<Landing>& landings) const {
  const ParameterRange& range = parameters_.range();
  std::vector<std::size_t> arrived;
  for (int step = 0; step < kMostSteps && !open.empty(); ++step) {
    std::vector<Vector2d> places;
    for (const std::size_t i : open) places.push_back(landings[i].parameters);
    const std::vector<Vector3d> here = surface_points(tag_, places);
    const std::vector<Tangents> along = surface_tangents(tag_, places);
    std::vector<std::size_t> still_open;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const std::size_t i = open[k];
      const double unit = edge(points[i]);
      double length = 0;
      Vector2d way = newton_step(points[i].point - here[k], along[k], length);
      if (!way.allFinite()) continue;
      if (length > kLongestStep * unit) way *= kLongestStep * unit / length;
      way = range.within(places[k] + way) - places[k];  // where the surface ends, so does the way
      landings[i].parameters = range.wrapped(places[k] + way);
      length = (way.x() * along[k].u + way.y() * along[k].v).norm();
      (length <= kLastStep * unit ? arrived : still_open).push_back(i);
    }
    open = std::move(still_open);
  }
  std::vector<Vector2d> places;
  for (const std::size_t i : arrived) places.push_back(landings[i].parameters);
  const std::vector<Vector3d> there = surface_points(tag_, places);
  for (std::size_t k = 0; k < arrived.size(); ++k) {
    const std::size_t i = arrived[k];
    landings[i].found = (there[k] - points[i].point).norm() <= kFarthest * std::max(edge(points[i]), points[i].chord);
    if (landings[i].found) landings[i].point = there[k];
  }
}

}  // namespace qmorph::adapter
