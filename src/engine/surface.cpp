#include "engine/surface.hpp"

#include <chrono>
#include <utility>

#include "engine/collector.hpp"
#include "parallel/for_each.hpp"
#include "parallel/shared_progress.hpp"
#include "quality/size_ratio.hpp"

namespace qmorph {
namespace {

/// The figures of one stage: the regions as they were then, put together.
void measure_stage(const Surface& surface, const std::vector<Snapshots>& regions, StageFigures& figures, bool keep) {
  Collector collector(surface.patch, surface.plane, surface.plane_points);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    std::size_t last = std::size_t(figures.stage);
    while (!regions[r][last]) --last;  // the input is always there
    collector.add(surface.regions[r], *regions[r][last]);
  }
  QuadMesh mesh = collector.finish();
  figures.quality.add(mesh.points, mesh.triangles, mesh.quads, surface.plane.normal());
  if (keep) figures.meshes.push_back(std::make_shared<const QuadMesh>(std::move(mesh)));
}

}  // namespace

Surface::Surface(const Patch& surface, const Plane& its_plane) : patch(surface), plane(its_plane) {
  plane_points.reserve(patch.points.size());
  for (const auto& p : patch.points) plane_points.push_back(plane.to_plane(p));
  regions = cut_into_regions(patch, plane_points);
}

QuadMesh work_on_regions(const Surface& surface, const Options& options, const Work& work) {
  /// What one region becomes.
  struct Part {
    kernel::Mesh mesh;
    ConversionStats stats;
    Snapshots snapshots;
  };
  std::vector<Part> parts(surface.regions.size());
  std::vector<parallel::Progress> progress;
  const parallel::SharedProgress shared(options.progress, double(surface.patch.triangles.size()));
  for (const Region& region : surface.regions) progress.push_back(shared.part(double(region.triangles.size())));
  parallel::for_each_index(parts.size(), [&](std::size_t r) {
    Options own = options;
    own.progress = progress[r];
    parts[r].mesh = work(r, own, parts[r].stats, options.measure_stages ? &parts[r].snapshots : nullptr);
  });

  ConversionStats stats;
  Collector collector(surface.patch, surface.plane, surface.plane_points);
  std::vector<Snapshots> snapshots;
  for (std::size_t r = 0; r < parts.size(); ++r) {
    stats.add(parts[r].stats);
    ++stats.regions;
    stats.odd_regions += surface.regions[r].boundary_sides % 2;
    collector.add(surface.regions[r], parts[r].mesh);
    snapshots.push_back(std::move(parts[r].snapshots));
  }
  QuadMesh mesh = collector.finish();
  for (StageFigures& figures : stats.stages) measure_stage(surface, snapshots, figures, options.keep_stages);
  if (options.measure_stages) stats.size_ratios = size_ratios(surface.patch, mesh);
  mesh.stats = std::move(stats);
  return mesh;
}

QuadMesh work_on_patch(const Patch& patch, const Options& options, const PatchWork& work) {
  QuadMesh mesh;
  parallel::with_threads(options.threads, [&] { mesh = work(patch, options); });
  return mesh;
}

std::vector<Outcome> work_on_patches(const std::vector<const Patch*>& patches, const Options& options,
                                     const PatchWork& work) {
  using Clock = std::chrono::steady_clock;
  const auto weight = [](const Patch& patch) { return double(patch.triangles.size() + 2 * patch.quads.size()); };
  double total = 0;
  for (const Patch* patch : patches) total += weight(*patch);
  const parallel::SharedProgress shared(options.progress, total);
  std::vector<parallel::Progress> progress;
  for (const Patch* patch : patches) progress.push_back(shared.part(weight(*patch)));

  std::vector<Outcome> outcomes(patches.size());
  const auto work_on = [&](std::size_t i) {
    const Clock::time_point start = Clock::now();
    Options own = options;
    own.progress = progress[i];
    try {
      outcomes[i].mesh = work(*patches[i], own);
    } catch (const SurfaceError& error) {
      outcomes[i].reason = error.what();
    }
    outcomes[i].seconds = std::chrono::duration<double>(Clock::now() - start).count();
  };
  parallel::with_threads(options.threads, [&] { parallel::for_each_index(patches.size(), work_on); });
  return outcomes;
}

}  // namespace qmorph
