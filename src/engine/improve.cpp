// SPDX-License-Identifier: GPL-2.0-or-later
#include <optional>

#include "chart/convert_curved.hpp"
#include "engine/improve_region.hpp"
#include "engine/mixed.hpp"
#include "engine/overlap.hpp"
#include "engine/surface.hpp"
#include "qmorph/convert.hpp"

namespace qmorph {
namespace {

SurfaceWork improve_patch(const Patch& patch, const Options& options, Budget& budget) {
  if (patch.triangles.empty() && patch.quads.empty()) return {};
  const Patch halves = cut_quads(patch);
  const std::size_t triangles = patch.triangles.size();
  const std::optional<Plane> plane = find_plane(halves);
  if (!plane) return chart::improve_curved(patch, options, budget);
  const Surface surface(halves, *plane);
  std::vector<ImproveStart> starts;
  std::vector<Region> regions;
  for (const Region& region : surface.regions) {
    starts.push_back(start_improving(region, join_halves(region, triangles), surface.plane, options));
    regions.push_back(starts.back().region);
  }
  require_no_overlap(regions, surface.plane);
  return work_on_regions(
      surface, options, budget,
      [&](std::size_t r, const Options& own, Budget& budget_of_region, ConversionReport& report, Record& record) {
        const kernel::Mesh input = join_halves(surface.regions[r], triangles);
        return improve_region(starts[r], input, surface.plane, own, budget_of_region, report, record);
      });
}

}  // namespace

Conversion improve(const Patch& patch, const Options& options) { return work_on_patch(patch, options, improve_patch); }

std::vector<Outcome> improve_all(const std::vector<const Patch*>& patches, const Options& options) {
  return work_on_patches(patches, options, improve_patch);
}

}  // namespace qmorph
