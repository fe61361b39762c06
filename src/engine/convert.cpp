#include "qmorph/convert.hpp"

#include "engine/collector.hpp"
#include "engine/convert_region.hpp"
#include "engine/overlap.hpp"
#include "engine/surface.hpp"

namespace qmorph {
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
