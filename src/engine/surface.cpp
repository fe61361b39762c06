#include "engine/surface.hpp"

#include "engine/collector.hpp"
#include "quality/size_ratio.hpp"

namespace qmorph {
namespace {

/// The figures of one stage: the regions as they were then, put together.
void measure_stage(const Surface& surface, const std::vector<Snapshots>& regions, StageFigures& figures) {
  Collector collector(surface.patch, surface.plane, surface.plane_points);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    std::size_t last = std::size_t(figures.stage);
    while (!regions[r][last]) --last;  // the input is always there
    collector.add(surface.regions[r], *regions[r][last]);
  }
  const QuadMesh mesh = collector.finish();
  figures.quality.add(mesh.points, mesh.triangles, mesh.quads, surface.plane.normal());
}

}  // namespace

Surface::Surface(const Patch& surface) : patch(surface), plane(fit_plane(surface)) {
  plane_points.reserve(patch.points.size());
  for (const auto& p : patch.points) plane_points.push_back(plane.to_plane(p));
  regions = cut_into_regions(patch, plane_points);
}

QuadMesh work_on_regions(const Surface& surface, bool measure_stages, const Work& work) {
  ConversionStats stats;
  std::vector<Snapshots> snapshots(measure_stages ? surface.regions.size() : 0);
  std::vector<kernel::Mesh> meshes;
  meshes.reserve(surface.regions.size());
  for (std::size_t r = 0; r < surface.regions.size(); ++r) {
    const Region& region = surface.regions[r];
    ++stats.regions;
    stats.odd_regions += region.boundary_sides % 2;
    meshes.push_back(work(r, stats, measure_stages ? &snapshots[r] : nullptr));
  }
  Collector collector(surface.patch, surface.plane, surface.plane_points);
  for (std::size_t r = 0; r < meshes.size(); ++r) collector.add(surface.regions[r], meshes[r]);
  QuadMesh mesh = collector.finish();
  for (StageFigures& figures : stats.stages) measure_stage(surface, snapshots, figures);
  if (measure_stages) stats.size_ratios = size_ratios(surface.patch, mesh);
  mesh.stats = std::move(stats);
  return mesh;
}

}  // namespace qmorph
