// SPDX-License-Identifier: GPL-2.0-or-later
#include "stretch/convert_stretched.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "chart/chart.hpp"
#include "engine/convert_region.hpp"
#include "engine/grid_pairs.hpp"
#include "engine/worth.hpp"
#include "geometry/predicates.hpp"
#include "qmorph/certificate.hpp"
#include "quality/directed_size.hpp"
#include "stretch/flat_lengths.hpp"
#include "stretch/metric_field.hpp"
#include "stretch/straighten.hpp"

namespace qmorph::stretch {
namespace {

/// Where nodes are stretched by more than that, triangles are stretched; as many of all make a region stretched.
constexpr double kStretched = 3, kShare = 0.2;
/// Fewer triangles may be what they are by chance, or because the boundary leaves no room; if they are not even alike.
constexpr std::size_t kFewest = 100, kFewestAlike = 16;
/// Of the chart against the lengths that it was made for: 99th percentile. Quads are smoothed by the metric in the end,
/// so that it may be more than on curved surfaces; that around holes there is any is what has no cure but cuts.
constexpr double kMostDistortion = 2;

/// A region of a plane as a surface in space.
struct Surface {
  std::vector<Eigen::Vector3d> points;
  std::vector<space::Background::Edge> barriers;
  space::Background background;

  explicit Surface(const Region& region)
      : points(points_of(region)), barriers(barriers_of(region)), background(points, region.triangles, barriers) {}

 private:
  static std::vector<Eigen::Vector3d> points_of(const Region& region) {
    std::vector<Eigen::Vector3d> points;
    points.reserve(region.points.size());
    for (const Vec2& p : region.points) points.emplace_back(p.x(), p.y(), 0);
    return points;
  }
  static std::vector<space::Background::Edge> barriers_of(const Region& region) {
    std::vector<space::Background::Edge> edges;
    for (Index side = 0; side < region.open.size(); ++side)
      if (region.open[side])
        edges.push_back({region.triangles[side / 3][side % 3], region.triangles[side / 3][(side + 1) % 3]});
    return edges;
  }
};

/// A look at single triangles: whether as many are so long that the region may be stretched, and none is turned over,
/// or without area: a chart would hide that.
bool may_be_stretched(const Region& region) {
  // The trace, and the determinant times four, of what has the squared stretches for eigenvalues.
  constexpr double kLeast = (kStretched + 1 / kStretched) * (kStretched + 1 / kStretched);
  std::size_t count = 0;
  for (const auto& [a, b, c] : region.triangles) {
    const Vec2 ab = region.points[b] - region.points[a], bc = region.points[c] - region.points[b],
               ca = region.points[a] - region.points[c];
    if (orientation(region.points[a], region.points[b], region.points[c]) <= 0) return false;
    const double trace = ab.squaredNorm() + bc.squaredNorm() + ca.squaredNorm(), area = cross(ab, bc);
    count += trace * trace > 3 * kLeast * area * area;
  }
  return double(count) >= kShare * double(region.triangles.size());
}

/// Enough nodes inside for the stretch to be the triangles' own: those between two curves, or around one node, are long
/// because there is nothing else to join.
bool has_inside(const space::Background& surface) {
  constexpr double kLeast = 0.25;  // of all nodes
  std::size_t boundary = 0;
  for (Index side = 0; side < 3 * surface.triangles(); ++side) boundary += surface.opposite(side) == kNone;
  const double all = double(surface.points().size());
  return all - double(boundary) >= kLeast * all;
}

/// The triangles laid flat so that they are about as long as wide; nothing if they are not stretched, or if that is not
/// possible.
std::optional<chart::Flattening> unfold(const space::Background& surface, const MetricField& field) {
  if (field.share_above(kStretched) < kShare) return {};
  if (const auto metric = field.uniform()) {
    const Eigen::Matrix2d map = metric->unstretch();
    chart::Flattening flattening;
    for (const Eigen::Vector3d& p : surface.points()) flattening.points.push_back(map * p.head<2>());
    return flattening;
  }
  if (surface.triangles() < kFewest || !has_inside(surface)) return {};
  const std::vector<double> lengths = flat_lengths(surface, field.side_lengths());
  if (lengths.empty()) return {};
  chart::Flattening flattening = chart::flatten(surface, surface.points().size(), chart::kAllRounds, lengths);
  if (flattening.flipped > 0 || flattening.distortion > kMostDistortion) return {};
  return flattening;
}

class StretchedRegion {
 public:
  StretchedRegion(const Region& region, const Plane& plane, const Surface& surface, const MetricField& field,
                  chart::Flattening flattening)
      : region_(region),
        plane_(plane),
        field_(field),
        chart_(surface.points, region.triangles, surface.barriers, std::move(flattening)) {}

  kernel::Mesh convert(const Options& options, double allowed, ConversionReport& report, Record& record) const {
    Region flat = region_;
    flat.points = chart_.flat();
    Plane plane = plane_;
    plane.curved = [this](const Vec2& p) { return plane_.to_space(in_plane(chart_.nearest_of_all(p))); };
    kernel::Mesh mesh = convert_region(flat, plane, options, allowed, report, record);
    for (auto& stage : record.stages)
      if (stage) lift(*stage, chart_.places(*stage));
    const std::vector<Place> places = chart_.places(mesh);
    lift(mesh, places);
    straighten(mesh, metrics_at(places));
    if (wants_stages(options)) record.stages.back() = mesh;
    return mesh;
  }

 private:
  using Place = chart::Chart::Place;

  Vec2 in_plane(const Place& place) const { return chart_.to_space(place).head<2>(); }

  void lift(kernel::Mesh& mesh, const std::vector<Place>& places) const {
    for (Index v = 0; v < places.size(); ++v)
      if (places[v].half != kNone)
        mesh.set_point(v, chart_.has_moved(mesh, v) ? in_plane(places[v]) : region_.points[v]);
  }

  std::vector<LogMetric> metrics_at(const std::vector<Place>& places) const {
    std::vector<LogMetric> metrics(places.size());
    for (Index v = 0; v < places.size(); ++v)
      if (places[v].half != kNone)
        for (int i = 0; i < 3; ++i)
          metrics[v] += field_.at(region_.triangles[places[v].half][std::size_t(i)]) * places[v].weights[i];
    return metrics;
  }

  const Region& region_;
  const Plane& plane_;
  const MetricField& field_;
  const chart::Chart chart_;
};

/// By how much sizes are off those of the triangles, in the direction in which that is more.
double size_ratio(const Region& region, const kernel::Mesh& mesh) {
  Patch before;
  for (const Vec2& p : region.points) before.points.emplace_back(p.x(), p.y(), 0);
  before.triangles = region.triangles;
  std::vector<Eigen::Vector3d> points;
  for (Index v = 0; v < mesh.vertex_slots(); ++v) points.emplace_back(mesh.point(v).x(), mesh.point(v).y(), 0);
  std::vector<std::array<Index, 4>> quads;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f) || mesh.degree(f) != 4) continue;
    const Index h = mesh.half_edge(f);
    quads.push_back({mesh.origin(h), mesh.target(h), mesh.target(mesh.next(h)), mesh.origin(mesh.prev(h))});
  }
  return largest_ratio(median(directed_sizes(before, points, quads)));
}

/// Share of the inner nodes that have other than four edges.
double irregular_share(const kernel::Mesh& mesh) {
  std::size_t inner = 0, irregular = 0;
  const std::vector<Index> valences = mesh.valences();
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v) || mesh.is_boundary(v)) continue;
    ++inner;
    irregular += valences[v] != 4;
  }
  return inner > 0 ? double(irregular) / double(inner) : 0;
}

/// What is straight by the metric is straight; what is right by the metric may be as thin in the plane as triangles
/// are.
bool is_valid(const kernel::Mesh& mesh, const MetricField& field) {
  const double least = std::max(kDegenerateSine, kStraightSine / field.largest_ratio());
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f) && !mesh.is_above(f, least)) return false;
  return true;
}

/// What an attempt has made.
struct Attempt {
  kernel::Mesh mesh{};
  ConversionReport report{};
  Record record{};
};

/// What decides between quads made in the chart and those of a front among the stretched triangles.
struct Measure {
  double size_ratio, irregular, least;

  bool loses_sizes() const { return size_ratio > kLargestSizeRatio; }
  bool is_poor() const { return least < kPoorQuad; }
  bool is_better_than(const Measure& other) const {
    // Such a front often keeps sizes by many small quads without any order.
    if (other.loses_sizes() && size_ratio + irregular < other.size_ratio + other.irregular) return true;
    return other.is_poor() && !is_poor() && !loses_sizes();
  }
};

Measure measure(const Attempt& attempt, const Region& region) {
  return {size_ratio(region, attempt.mesh), irregular_share(attempt.mesh),
          worth_of(attempt.mesh, region.triangles.size()).least};
}

/// Nothing if there is no valid result.
template <class Work>
std::optional<Attempt> attempt(const MetricField& field, const Work& work) {
  try {
    Attempt result;
    result.mesh = work(result);
    if (!is_valid(result.mesh, field)) return {};
    return result;
  } catch (const SurfaceError&) {
    return {};
  }
}

}  // namespace

std::optional<kernel::Mesh> convert_stretched(const Region& region, const Plane& plane, const Options& options,
                                              double allowed, ConversionReport& report, Record& record) {
  if (region.triangles.size() < kFewestAlike || !may_be_stretched(region)) return {};
  if (is_good_grid(kernel::Mesh(region.points, region.triangles, region.open))) return {};  // its cells are kept
  const Surface surface(region);
  const MetricField field(surface.background);
  std::optional<chart::Flattening> flattening = unfold(surface.background, field);
  if (!flattening) return {};
  const StretchedRegion stretched(region, plane, surface, field, std::move(*flattening));
  std::optional<Attempt> best =
      attempt(field, [&](Attempt& own) { return stretched.convert(options, allowed, own.report, own.record); });
  if (!best) return {};
  const Measure own = measure(*best, region);
  if (own.loses_sizes() || own.is_poor()) {
    const std::size_t cost = best->mesh.work();
    std::optional<Attempt> plain = attempt(field, [&](Attempt& other) {
      return convert_region(region, plane, options, allowed - double(cost), other.report, other.record);
    });
    if (plain) plain->mesh.add_work(cost);
    if (plain && measure(*plain, region).is_better_than(own)) best = std::move(plain);
  }
  report = best->report;
  record = std::move(best->record);
  return std::move(best->mesh);
}

}  // namespace qmorph::stretch
