#include "qmorph/convert.hpp"

#include <algorithm>
#include <chrono>
#include <string>

#include "cleanup/clean_up.hpp"
#include "cleanup/repair.hpp"
#include "elimination/eliminate.hpp"
#include "engine/overlap.hpp"
#include "engine/prepare.hpp"
#include "engine/regions.hpp"
#include "front/morph.hpp"
#include "kernel/mesh.hpp"
#include "smoothing/smooth.hpp"

namespace qmorph {
namespace {

class Stopwatch {
 public:
  /// Seconds since construction or the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Puts the regions of one patch together again.
class Collector {
 public:
  Collector(const Patch& patch, const Plane& plane, const std::vector<Vec2>& plane_points)
      : patch_(patch), plane_(plane), plane_points_(plane_points),
        row_(patch.points.size(), kNone), used_(patch.points.size(), false) {
    for (const auto& q : patch.quads)
      for (Index v : q) used_[v] = true;
  }

  void add(const Region& region, kernel::Mesh mesh) {
    for (Index v = 0; v < region.node.size(); ++v)
      if (mesh.is_live_vertex(v)) used_[region.node[v]] = true;
    parts_.emplace_back(&region, std::move(mesh));
  }

  QuadMesh finish() {
    for (Index i = 0; i < patch_.points.size(); ++i)
      if (used_[i]) row_[i] = append(patch_.points[i], i);
    for (const auto& q : patch_.quads)
      result_.quads.push_back({row_[q[0]], row_[q[1]], row_[q[2]], row_[q[3]]});
    for (const auto& [region, mesh] : parts_) add_elements(*region, mesh);
    return std::move(result_);
  }

 private:
  Index append(const Eigen::Vector3d& p, Index source) {
    result_.points.push_back(p);
    result_.source.push_back(source);
    return Index(result_.points.size() - 1);
  }

  void add_elements(const Region& region, const kernel::Mesh& mesh) {
    std::vector<Index> row(mesh.vertex_slots(), kNone);
    for (Index v = 0; v < mesh.vertex_slots(); ++v) {
      if (!mesh.is_live_vertex(v)) continue;
      if (v < region.node.size()) {
        const Index node = region.node[v];
        row[v] = row_[node];
        // A node that did not move keeps its coordinates to the bit.
        if (mesh.point(v) != plane_points_[node])
          result_.points[row[v]] = plane_.to_space(mesh.point(v));
      } else {
        row[v] = append(plane_.to_space(mesh.point(v)), kNone);
      }
    }
    for (Index f = 0; f < mesh.face_slots(); ++f) {
      if (!mesh.is_live_face(f)) continue;
      const Index h = mesh.half_edge(f);
      const Index a = mesh.origin(h), b = mesh.target(h), c = mesh.target(mesh.next(h));
      if (mesh.degree(f) == 3)
        result_.triangles.push_back({row[a], row[b], row[c]});
      else
        result_.quads.push_back({row[a], row[b], row[c], row[mesh.origin(mesh.prev(h))]});
    }
  }

  const Patch& patch_;
  const Plane& plane_;
  const std::vector<Vec2>& plane_points_;
  std::vector<Index> row_;
  std::vector<bool> used_;
  std::vector<std::pair<const Region*, kernel::Mesh>> parts_;
  QuadMesh result_;
};

std::size_t count_faces(const kernel::Mesh& mesh, Index degree) {
  std::size_t count = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    count += mesh.is_live_face(f) && mesh.degree(f) == degree;
  return count;
}

/// What contradicts invariants I4 and I5, in words; empty if nothing does. The stages keep them step by step;
/// this is the last word.
std::string find_fault(const kernel::Mesh& mesh, const Region& region, const Plane& plane) {
  std::size_t triangles = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    const auto where = [&] {
      return describe(plane.to_space(mesh.point(mesh.origin(mesh.half_edge(f)))));
    };
    if (!mesh.is_valid_face(f))
      return "no valid element was found at " + where() +
             "; refine the triangles or the boundary there";
    if (mesh.degree(f) == 3 && ++triangles > region.boundary_sides % 2)
      return "the triangle at " + where() +
             " could not be removed; refine the triangles or the boundary there";
  }
  return {};
}

/// The stages, one after another.
class Pipeline {
 public:
  Pipeline(const Options& options, ConversionStats& stats) : options_(options), stats_(stats) {}

  void advance_front(kernel::Mesh& mesh) {
    front::morph(mesh, options_.front, options_.check_each_step,
                 [&](double share) { progress("front", share); });
    stats_.front_quads += count_faces(mesh, 4);
    stats_.leftover_triangles += count_faces(mesh, 3);
    stats_.front_seconds += watch_.lap();
  }

  void finish(kernel::Mesh& mesh) {
    elimination::eliminate_triangles(mesh, options_.smoothing);
    stats_.elimination_seconds += watch_.lap();
    progress("smoothing", 0);
    SmoothingOptions rough = options_.smoothing;  // good enough for cleanup to judge shapes
    rough.iterations = std::min(rough.iterations, 3);
    smoothing::smooth(mesh, rough);
    stats_.smoothing_seconds += watch_.lap();
    progress("cleanup", 0);
    cleanup::clean_up(mesh, options_.smoothing);
    stats_.cleanup_seconds += watch_.lap();
    progress("smoothing", 0.5);
    smoothing::smooth(mesh, options_.smoothing);
    stats_.smoothing_seconds += watch_.lap();
    cleanup::repair(mesh, options_.smoothing);
    // Better shapes may have opened a way for triangles that found none before.
    if (count_faces(mesh, 3) > 1) elimination::eliminate_triangles(mesh, options_.smoothing);
    stats_.cleanup_seconds += watch_.lap();
  }

 private:
  void progress(std::string_view stage, double share) const {
    if (options_.progress) options_.progress(stage, share);
  }

  const Options& options_;
  ConversionStats& stats_;
  Stopwatch watch_;
};

kernel::Mesh convert_region(const Region& region, const Plane& plane, const Options& options,
                            ConversionStats& stats) {
  kernel::Mesh start(region.points, region.triangles, region.open);
  for (Index v : region.fixed) start.set_fixed(v);
  repair_input(start, plane);

  Pipeline pipeline(options, stats);
  kernel::Mesh mesh = start;
  pipeline.advance_front(mesh);
  pipeline.finish(mesh);
  const std::string fault = find_fault(mesh, region, plane);
  if (fault.empty()) return mesh;

  // A front has no room in fans and needles. Pairing the triangles as they are often has.
  pipeline.finish(start);
  if (!find_fault(start, region, plane).empty()) throw SurfaceError(fault);
  return start;
}

}  // namespace

QuadMesh convert(const Patch& patch, const Options& options) {
  require_sound(patch);
  if (patch.triangles.empty()) {
    Collector nothing(patch, {}, {});
    return nothing.finish();
  }
  const Plane plane = fit_plane(patch);
  std::vector<Vec2> plane_points;
  plane_points.reserve(patch.points.size());
  for (const auto& p : patch.points) plane_points.push_back(plane.to_plane(p));
  const std::vector<Region> regions = cut_into_regions(patch, plane_points);

  require_no_overlap(regions, plane);

  ConversionStats stats;
  Collector collector(patch, plane, plane_points);
  for (const Region& region : regions) {
    ++stats.regions;
    stats.odd_regions += region.boundary_sides % 2;
    collector.add(region, convert_region(region, plane, options, stats));
  }
  QuadMesh mesh = collector.finish();
  mesh.stats = stats;
  return mesh;
}

}  // namespace qmorph
