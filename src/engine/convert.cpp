#include "qmorph/convert.hpp"

#include "chart/convert_curved.hpp"
#include "engine/collector.hpp"
#include "engine/convert_region.hpp"
#include "engine/overlap.hpp"
#include "engine/surface.hpp"

namespace qmorph {
namespace {

SurfaceWork convert_patch(const Patch& patch, const Options& options, double allowed) {
  require_sound(patch);
  if (patch.triangles.empty()) return {{Collector(patch, {}, {}).finish(), {}}, {}, 0};
  const std::optional<Plane> plane = find_plane(patch);
  if (!plane) return chart::convert_curved(patch, options, allowed);
  const Surface surface(patch, *plane);
  require_no_overlap(surface.regions, surface.plane);
  return work_on_regions(
      surface, options, allowed,
      [&](std::size_t r, const Options& own, double most, ConversionReport& report, Record& record) {
        return convert_region(surface.regions[r], surface.plane, own, most, report, record);
      });
}

}  // namespace

Conversion convert(const Patch& patch, const Options& options) { return work_on_patch(patch, options, convert_patch); }

std::vector<Outcome> convert_all(const std::vector<const Patch*>& patches, const Options& options) {
  return work_on_patches(patches, options, convert_patch);
}

}  // namespace qmorph
