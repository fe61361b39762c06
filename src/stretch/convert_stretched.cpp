// SPDX-License-Identifier: GPL-2.0-or-later
#include "stretch/convert_stretched.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "bands/relay_rows.hpp"
#include "engine/convert_region.hpp"
#include "engine/grid_pairs.hpp"
#include "engine/worth.hpp"
#include "geometry/predicates.hpp"
#include "qmorph/certificate.hpp"
#include "quality/directed_size.hpp"
#include "stretch/metric_field.hpp"
#include "stretch/unfolded.hpp"

namespace qmorph::stretch {
namespace {

/// Fewer triangles may be what they are by chance, or because the boundary leaves no room, though they are alike.
constexpr std::size_t kFewestAlike = 16;
/// What a chart costs, and quads in it, for each triangle: with less there is no hope for them.
constexpr std::size_t kLeastWork = 300;
/// What making its quads rectangles costs, for each triangle.
constexpr std::size_t kWorkToStraighten = 330;

/// A look at single triangles: whether as many are so long that the region may be stretched, and none is turned over,
/// or without area: a chart would hide that.
bool may_be_stretched(const Region& region) {
  std::size_t count = 0;
  for (const auto& [a, b, c] : region.triangles) {
    const Vec2 ab = region.points[b] - region.points[a], bc = region.points[c] - region.points[b],
               ca = region.points[a] - region.points[c];
    if (orientation(region.points[a], region.points[b], region.points[c]) <= 0) return false;
    count += is_stretched_by(kStretched, ab.squaredNorm() + bc.squaredNorm() + ca.squaredNorm(), cross(ab, bc));
  }
  return double(count) >= kStretchedShare * double(region.triangles.size());
}

/// Whether the stretch is the triangles' own.
bool is_stretched(const space::Background& surface, const MetricField& field) {
  if (!field.is_stretched()) return false;
  if (field.uniform()) return true;
  std::size_t outer = 0;
  for (Index side = 0; side < 3 * surface.triangles(); ++side) outer += surface.opposite(side) == kNone;
  return has_inside(surface.triangles(), surface.points().size(), outer);
}

/// Quads of the region, made in the chart.
kernel::Mesh convert_in(const Unfolded& chart, const Region& region, const Plane& plane, const Options& options,
                        Budget& budget, ConversionReport& report, Record& record) {
  Region flat = region;
  flat.points = chart.flat();
  Plane own = plane;
  own.curved = [&](const Vec2& p) { return plane.to_space(chart.in_plane(p)); };
  budget.spend(double(kWorkToStraighten * region.triangles.size()));
  kernel::Mesh mesh = convert_region(flat, own, options, budget, report, record);
  for (auto& stage : record.stages)
    if (stage) chart.lift(*stage);
  chart.lift_and_straighten(mesh);
  bands::relay_leaning_rows(mesh, options.smoothing, {mesh, std::size_t(std::max(0.0, budget.left()))});
  if (wants_stages(options)) record.stages.back() = mesh;
  return mesh;
}

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

/// What an attempt has made.
struct Attempt {
  kernel::Mesh mesh{};
  ConversionReport report{};
  Record record{};
};

/// What decides between quads made in the chart and those of a front among the stretched triangles.
struct Measure {
  double size_ratio;        ///< by how much sizes are off
  double irregular, least;  ///< share of nodes; smallest sine

  bool loses_sizes() const { return size_ratio > kLargestSizeRatio; }
  bool is_poor() const { return least < kPoorQuad; }
  bool is_good() const { return !loses_sizes() && !is_poor(); }
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

std::optional<StretchedQuads> convert_stretched(const Region& region, const Plane& plane, const Options& options,
                                                Budget& budget, ConversionReport& report, Record& record) {
  if (budget.left() < double(kLeastWork * region.triangles.size())) return {};
  if (region.triangles.size() < kFewestAlike || !may_be_stretched(region)) return {};
  if (is_good_grid(kernel::Mesh(region.points, region.triangles, region.open))) return {};  // its cells are kept
  const Surface surface(region.points, region.triangles, boundary_edges(region));
  const MetricField field(surface.background);
  if (!is_stretched(surface.background, field)) return {};
  std::optional<chart::Flattening> flattening = unfold(surface.background, field);
  if (!flattening) return {};
  const Unfolded chart(surface, field, std::move(*flattening));
  std::optional<Attempt> best = attempt(
      field, [&](Attempt& own) { return convert_in(chart, region, plane, options, budget, own.report, own.record); });
  if (!best) return {};
  const Measure own = measure(*best, region);
  bool in_chart = true;
  if (!own.is_good()) {
    std::optional<Attempt> plain = attempt(field, [&](Attempt& other) {
      return convert_region(region, plane, options, budget, other.report, other.record);
    });
    if (plain && measure(*plain, region).is_better_than(own)) best = std::move(plain), in_chart = false;
  }
  report = best->report;
  record = std::move(best->record);
  return StretchedQuads{std::move(best->mesh), in_chart};
}

}  // namespace qmorph::stretch
