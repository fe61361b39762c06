// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/divide/curves.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::adapter {
namespace {

constexpr int kFiner = 4;

/// Points and parameters of the finer nodes. False if it has no parameters.
bool read_nodes(DividedCurve& curve) {
  std::vector<double> low, high, ends;
  ::gmsh::model::getParametrizationBounds(1, curve.tag, low, high);
  if (low.size() != 1 || high.size() != 1 || !(low[0] < high[0])) return false;
  curve.parameters.push_back(low[0]);
  for (const auto& [parameter, node] : nodes_along(curve.tag)) curve.parameters.push_back(parameter);
  curve.parameters.push_back(high[0]);
  std::vector<double> xyz;
  ::gmsh::model::getValue(1, curve.tag, curve.parameters, xyz);
  if (xyz.size() != 3 * curve.parameters.size()) return false;
  for (std::size_t i = 0; i < xyz.size(); i += 3) curve.points.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  for (std::size_t i = 1; i < curve.points.size(); ++i) curve.length += (curve.points[i] - curve.points[i - 1]).norm();
  return std::is_sorted(curve.parameters.begin(), curve.parameters.end());
}

bool read_ends(DividedCurve& curve) {
  ::gmsh::vectorpair points;
  ::gmsh::model::getBoundary({{1, curve.tag}}, points, false, false);
  if (points.empty() || points.size() > 2) return false;
  curve.ends = {points.front().second, points.back().second};
  std::vector<double> first;
  ::gmsh::model::getValue(0, curve.ends[0], {}, first);
  if (first.size() != 3) return false;
  const Eigen::Vector3d p(first[0], first[1], first[2]);
  if ((p - curve.points.front()).norm() > (p - curve.points.back()).norm()) std::swap(curve.ends[0], curve.ends[1]);
  return true;
}

std::vector<Index> as_curves(const CurveModel& model, const ::gmsh::vectorpair& entities) {
  std::vector<Index> curves;
  for (const auto& [dim, tag] : entities)
    if (const Index found = model.find(tag); dim == 1 && found != kNone) curves.push_back(found);
  return curves;
}

BoundedSurface read_surface(const CurveModel& model, int tag) {
  BoundedSurface surface{tag, {}, {}};
  ::gmsh::vectorpair boundary;
  ::gmsh::model::getBoundary({{2, tag}}, boundary, false, false);
  surface.boundary = as_curves(model, boundary);
  ::gmsh::vectorpair embedded;
  ::gmsh::model::mesh::getEmbedded(2, tag, embedded);
  surface.embedded = as_curves(model, embedded);
  return surface;
}

/// Gmsh copies the nodes of the one to the other.
void add_periodic(CurveModel& model) {
  for (Index c = 0; c < model.curves.size(); ++c) {
    int master = 0;
    std::vector<std::size_t> nodes, masters;
    std::vector<double> transformation;
    ::gmsh::model::mesh::getPeriodicNodes(1, model.curves[c].tag, master, nodes, masters, transformation);
    if (const Index other = model.find(master); other != kNone && other != c) model.images.emplace_back(other, c);
  }
}

/// What is extruded in layers has sides whose number does not depend on the size, and the same number on the other two,
/// one of which is a copy of the other. No call of Gmsh's API tells.
void add_extruded(CurveModel& model) {
  for (const BoundedSurface& surface : model.surfaces) {
    const std::vector<Index>& sides = surface.boundary;
    if (sides.size() < 3 || sides.size() > 4) continue;
    std::vector<Index> fixed, moving;
    for (Index c : sides) (model.curves[c].depends_on_size() ? moving : fixed).push_back(c);
    if (moving.size() != 2 || fixed.empty()) continue;
    DividedCurve &a = model.curves[moving[0]], &b = model.curves[moving[1]];
    const bool same = model.curves[fixed.front()].segments == model.curves[fixed.back()].segments;
    if (!same || a.segments != b.segments || a.finer != b.finer || a.segments <= 1) continue;
    model.images.emplace_back(moving[0], moving[1]);
    a.carried = b.carried = true;
  }
}

/// No point is farther from the chord than a share of its length.
bool is_straight(const DividedCurve& curve) {
  constexpr double kBend = 0.01;
  constexpr int kSamples = 8;
  std::vector<double> parameters;
  for (int i = 1; i < kSamples; ++i)
    parameters.push_back(curve.parameters.front() +
                         i * (curve.parameters.back() - curve.parameters.front()) / kSamples);
  const Eigen::Vector3d chord = curve.points.back() - curve.points.front();
  const std::vector<Eigen::Vector3d> points = points_at(curve, parameters);
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& p) {
    return (p - curve.points.front()).cross(chord).norm() <= kBend * chord.squaredNorm();
  });
}

/// Where another curve has the same ends, one segment of each would lie on the other. Transfinite curves of two
/// segments have two at any size.
void find_spare(CurveModel& model) {
  std::map<std::pair<int, int>, int> between;
  const auto ends = [](const DividedCurve& curve) { return std::minmax(curve.ends[0], curve.ends[1]); };
  for (const DividedCurve& curve : model.curves) ++between[ends(curve)];
  for (DividedCurve& curve : model.curves)
    curve.is_spare = curve.segments == 2 && curve.finer == 1 && curve.ends[0] != curve.ends[1] &&
                     between[ends(curve)] == 1 && is_straight(curve);
}

}  // namespace

double DividedCurve::wish() const {
  if (is_spare) return double(finer) / kFiner;
  // Gmsh nearly always rounds up. Half a segment is taken back, so that its own number is the nearest.
  const double exact = std::clamp((finer - 0.5) / kFiner, segments - 0.95, double(segments));
  return (exact + segments) / 2;
}

double DividedCurve::parameter_at(double at) const {
  const std::size_t below = std::min(std::size_t(at), parameters.size() - 2);
  return parameters[below] + (at - double(below)) * (parameters[below + 1] - parameters[below]);
}

Index CurveModel::find(int tag) const {
  const auto at = std::lower_bound(curves.begin(), curves.end(), tag,
                                   [](const DividedCurve& curve, int wanted) { return curve.tag < wanted; });
  return at == curves.end() || at->tag != tag ? kNone : Index(at - curves.begin());
}

std::vector<double> parameters_for(const DividedCurve& curve, int segments) {
  std::vector<double> parameters;
  for (int i = 1; i < segments; ++i) parameters.push_back(curve.parameter_at(double(i) * curve.finer / segments));
  return parameters;
}

std::vector<Eigen::Vector3d> points_at(const DividedCurve& curve, const std::vector<double>& parameters) {
  std::vector<double> xyz;
  ::gmsh::model::getValue(1, curve.tag, parameters, xyz);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) points.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  return points;
}

int count_segments(int curve) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  ::gmsh::model::mesh::getElements(types, tags, nodes, 1, curve);
  std::size_t count = 0;
  for (const auto& block : tags) count += block.size();
  return int(count);
}

std::vector<std::pair<double, std::size_t>> nodes_along(int curve) {
  std::vector<std::size_t> tags;
  std::vector<double> xyz, parameters;
  ::gmsh::model::mesh::getNodes(tags, xyz, parameters, 1, curve);
  std::vector<std::pair<double, std::size_t>> nodes;
  for (std::size_t i = 0; i < tags.size() && parameters.size() == tags.size(); ++i)
    nodes.emplace_back(parameters[i], tags[i]);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::optional<CurveModel> divide_as_wished(const std::vector<int>& surfaces) {
  CurveModel model;
  ::gmsh::vectorpair entities, after;
  ::gmsh::model::getEntities(entities, 1);
  std::sort(entities.begin(), entities.end());
  bool understood = true;
  {
    const ScopedOption size("Mesh.MeshSizeFactor", get_option("Mesh.MeshSizeFactor") / kFiner);
    // A small circle has a least number of segments, and would seem to have it at any size.
    const ScopedOption circles("Mesh.MinimumCircleNodes", get_option("Mesh.MinimumCircleNodes") * kFiner);
    const ScopedOption curves("Mesh.MinimumCurveNodes", 2);
    ::gmsh::model::mesh::generate(1);
    for (const auto& [dim, tag] : entities) {
      DividedCurve curve;
      curve.tag = tag;
      curve.finer = count_segments(tag);
      if (curve.finer > 0)
        understood = understood && read_nodes(curve) && read_ends(curve) &&
                     curve.parameters.size() == std::size_t(curve.finer) + 1;
      model.curves.push_back(std::move(curve));
    }
  }
  ::gmsh::model::mesh::generate(1);
  ::gmsh::model::getEntities(after, 1);
  if (!understood || after.size() != entities.size()) return std::nullopt;  // a compound has a curve of its own
  for (DividedCurve& curve : model.curves) curve.segments = count_segments(curve.tag);
  if (get_option("Mesh.MinimumCurveNodes") > 2) find_spare(model);
  for (int tag : surfaces) model.surfaces.push_back(read_surface(model, tag));
  add_periodic(model);
  add_extruded(model);
  return model;
}

}  // namespace qmorph::adapter
