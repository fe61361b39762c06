#include "qmorph/convert.hpp"

#include "engine/collector.hpp"
#include "engine/fans.hpp"
#include "engine/overlap.hpp"
#include "engine/prepare.hpp"
#include "engine/surface.hpp"

namespace qmorph {
namespace {

kernel::Mesh convert_region(const Region& region, const Plane& plane, const Options& options, ConversionStats& stats,
                            Snapshots* snapshots) {
  kernel::Mesh start(region.points, region.triangles, region.open);
  for (Index v : region.fixed) start.set_fixed(v);
  Pipeline pipeline(options, stats, snapshots, start);
  repair_input(start, plane);
  grade_fans(start);

  std::string fault = find_needles(start, plane);
  if (fault.empty()) {
    kernel::Mesh mesh = start;
    pipeline.advance_front(mesh);
    pipeline.finish(mesh);
    fault = find_fault(mesh, region, plane);
    if (fault.empty()) return mesh;
  }

  // A front has no room in fans and needles. Pairing the triangles as they are often has.
  pipeline.finish(start);
  if (!find_fault(start, region, plane).empty()) throw SurfaceError(fault);
  return start;
}

}  // namespace

QuadMesh convert(const Patch& patch, const Options& options) {
  require_sound(patch);
  if (patch.triangles.empty()) return Collector(patch, {}, {}).finish();
  const Surface surface(patch);
  require_no_overlap(surface.regions, surface.plane);
  return work_on_regions(surface, options.measure_stages,
                         [&](std::size_t r, ConversionStats& stats, Snapshots* snapshots) {
                           return convert_region(surface.regions[r], surface.plane, options, stats, snapshots);
                         });
}

}  // namespace qmorph
