// SPDX-License-Identifier: GPL-2.0-or-later
#include "stretch/unfolded.hpp"

#include <algorithm>
#include <utility>

#include "geometry/predicates.hpp"
#include "stretch/flat_lengths.hpp"
#include "stretch/straighten.hpp"

namespace qmorph::stretch {
namespace {

/// Of the chart against the lengths that it was made for: 99th percentile. Quads are smoothed by the metric in the end,
/// so that it may be more than on curved surfaces; that around holes there is any is what has no cure but cuts.
constexpr double kMostDistortion = 2;

std::vector<Eigen::Vector3d> in_space(const std::vector<Vec2>& flat) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(flat.size());
  for (const Vec2& p : flat) points.emplace_back(p.x(), p.y(), 0);
  return points;
}

}  // namespace

Surface::Surface(const std::vector<Vec2>& flat, std::vector<space::Background::Triangle> its_triangles,
                 std::vector<space::Background::Edge> its_barriers)
    : points(in_space(flat)),
      triangles(std::move(its_triangles)),
      barriers(std::move(its_barriers)),
      background(points, triangles, barriers) {}

std::optional<chart::Flattening> unfold(const space::Background& surface, const MetricField& field) {
  if (const auto metric = field.uniform()) {
    const Eigen::Matrix2d map = metric->unstretch();
    chart::Flattening flattening;
    for (const Eigen::Vector3d& p : surface.points()) flattening.points.push_back(map * p.head<2>());
    return flattening;
  }
  const std::vector<double> lengths = flat_lengths(surface, field.side_lengths());
  if (lengths.empty()) return {};
  chart::Flattening flattening = chart::flatten(surface, surface.points().size(), chart::kAllRounds, lengths);
  if (flattening.flipped > 0 || flattening.distortion > kMostDistortion) return {};
  return flattening;
}

void Unfolded::lift(kernel::Mesh& mesh, const std::vector<Place>& places) const {
  for (Index v = 0; v < places.size(); ++v)
    if (places[v].half != kNone)
      mesh.set_point(v, chart_.has_moved(mesh, v) ? in_plane(places[v]) : Vec2(surface_.points[v].head<2>()));
}

void Unfolded::lift_and_straighten(kernel::Mesh& mesh) const {
  const std::vector<Place> places = chart_.places(mesh);
  lift(mesh, places);
  std::vector<LogMetric> metrics(places.size());
  for (Index v = 0; v < places.size(); ++v)
    if (places[v].half != kNone)
      for (int i = 0; i < 3; ++i)
        metrics[v] += field_.at(surface_.triangles[places[v].half][std::size_t(i)]) * places[v].weights[i];
  straighten(mesh, metrics);
}

bool is_valid(const kernel::Mesh& mesh, const MetricField& field) {
  const double least = std::max(kDegenerateSine, kStraightSine / field.largest_ratio());
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f) && !mesh.is_above(f, least)) return false;
  return true;
}

}  // namespace qmorph::stretch
