#include <optional>
#include <utility>

#include "engine/collector.hpp"
#include "engine/mixed.hpp"
#include "engine/overlap.hpp"
#include "engine/pipeline.hpp"
#include "engine/prepare.hpp"
#include "engine/surface.hpp"
#include "qmorph/convert.hpp"

namespace qmorph {
namespace {

/// A region whose elements are valid now, as triangles alone and as the mesh that it is.
struct Start {
  Region region;
  kernel::Mesh mesh;
};

Start make_start(const Region& region, std::size_t triangles, const Plane& plane, const Options& options) {
  Start start{region, join_halves(region, triangles)};
  mend_quads(start.mesh, options.smoothing, plane);
  repair_input(start.mesh, plane);
  take_triangles(start.mesh, start.region);
  return start;
}

/// Uses up `start`.
kernel::Mesh improve_region(Start& start, const kernel::Mesh& input, const Plane& plane, const Options& options,
                            double allowed, ConversionReport& report, Record& record) {
  Pipeline pipeline(options, report, record, input, allowed);
  kernel::Mesh mesh = std::move(start.mesh);
  pipeline.finish(mesh);
  const std::optional<SurfaceError> fault = find_fault(mesh, start.region, plane);
  if (!fault) return mesh;

  // What quads leave no room for may be possible without them.
  kernel::Mesh triangles(start.region.points, start.region.triangles, start.region.open);
  for (Index v : start.region.fixed) triangles.set_fixed(v);
  pipeline.advance_front(triangles, plane);
  pipeline.finish(triangles);
  if (find_fault(triangles, start.region, plane)) throw *fault;
  return triangles;
}

SurfaceWork improve_patch(const Patch& patch, const Options& options, double allowed) {
  require_sound(patch);
  if (patch.triangles.empty() && patch.quads.empty()) return {};
  const Patch halves = cut_quads(patch);
  const std::size_t triangles = patch.triangles.size();
  const Surface surface(halves);
  std::vector<Start> starts;
  std::vector<Region> regions;
  for (const Region& region : surface.regions) {
    starts.push_back(make_start(region, triangles, surface.plane, options));
    regions.push_back(starts.back().region);
  }
  require_no_overlap(regions, surface.plane);
  return work_on_regions(
      surface, options, allowed,
      [&](std::size_t r, const Options& own, double most, ConversionReport& report, Record& record) {
        const kernel::Mesh input = wants_stages(own) ? join_halves(surface.regions[r], triangles) : kernel::Mesh();
        return improve_region(starts[r], input, surface.plane, own, most, report, record);
      });
}

}  // namespace

Conversion improve(const Patch& patch, const Options& options) { return work_on_patch(patch, options, improve_patch); }

std::vector<Outcome> improve_all(const std::vector<const Patch*>& patches, const Options& options) {
  return work_on_patches(patches, options, improve_patch);
}

}  // namespace qmorph
