// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/convert_triangles.hpp"

#include <utility>

#include "chart/convert_curved.hpp"
#include "engine/canonical/rounded.hpp"
#include "engine/collector.hpp"
#include "engine/convert_region.hpp"
#include "engine/overlap.hpp"
#include "engine/pipeline.hpp"
#include "stretch/convert_stretched.hpp"

namespace qmorph {
namespace {

kernel::Mesh convert_flat(const Region& region, const Plane& plane, const Options& options, Budget& budget,
                          ConversionReport& report, Record& record) {
  if (options.layers)
    if (auto quads = stretch::convert_stretched(region, plane, options, budget, report, record))
      return std::move(quads->mesh);
  return convert_region(region, plane, options, budget, report, record);
}

/// With rounded coordinates, which the region has meanwhile; nothing where they are not to be rounded, or where an
/// element would be bad without that.
std::optional<kernel::Mesh> convert_rounded(Region& region, const Plane& plane, const Options& options, Budget& budget,
                                            ConversionReport& report, Record& record) {
  auto rounding = canonical::round_points(region, plane);
  if (!rounding) return {};
  std::optional<kernel::Mesh> mesh;
  try {
    mesh = convert_flat(region, rounding->plane, options, budget, report, record);
    canonical::put_back(*mesh, *rounding, region);
    for (auto& stage : record.stages)
      if (stage) canonical::put_back(*stage, *rounding, region);
  } catch (const SurfaceError&) {
  }
  region.points = std::move(rounding->exact);
  if (mesh && !find_fault(*mesh, region, plane)) return mesh;
  report = {};
  record = {};
  return {};
}

}  // namespace

SurfaceWork convert_triangles(const Patch& patch, const std::optional<Plane>& plane, const Options& options,
                              Budget& budget, std::vector<bool>* stuck) {
  if (patch.triangles.empty()) return {{Collector(patch, {}, {}).finish(), {}}, {}};
  if (!plane) return chart::convert_curved(patch, options, budget, stuck);
  Surface surface(patch, *plane);
  require_no_overlap(surface.regions, surface.plane);
  std::vector<char> is_stuck(surface.regions.size(), false), is_converted = is_stuck;
  const auto work = [&](std::size_t r, const Options& own, Budget& budget_of_region, ConversionReport& report,
                        Record& record) {
    try {
      Region& region = surface.regions[r];
      auto mesh = convert_rounded(region, surface.plane, own, budget_of_region, report, record);
      if (!mesh) mesh = convert_flat(region, surface.plane, own, budget_of_region, report, record);
      is_converted[r] = true, is_stuck[r] = false;
      return std::move(*mesh);
    } catch (const SurfaceError&) {
      if (!stuck || is_converted[r]) throw;
      is_stuck[r] = true;
      record = {};
      if (wants_stages(own)) record.stages.front() = kernel::Mesh();
      return kernel::Mesh();
    }
  };
  SurfaceWork result = work_on_regions(surface, options, budget, work);
  for (std::size_t r = 0; r < is_stuck.size(); ++r)
    if (is_stuck[r])
      for (Index v : surface.regions[r].node) (*stuck)[v] = true;
  return result;
}

}  // namespace qmorph
