// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/convert_with_layers.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/convert_triangles.hpp"
#include "engine/grid_pairs.hpp"
#include "engine/overlap.hpp"
#include "engine/pipeline.hpp"
#include "layers/find_layers.hpp"
#include "layers/meetings.hpp"
#include "space/creases.hpp"

namespace qmorph {
namespace {

QuadMesh as_it_was(const Patch& patch) {
  QuadMesh mesh{patch.points, {}, patch.triangles, patch.quads};
  for (Index i = 0; i < patch.points.size(); ++i) mesh.source.push_back(i);
  return mesh;
}

/// What the front has made of the rest, as a conversion of the patch.
void add_layers(const Patch& patch, const layers::Layers& layers, const std::optional<Plane>& plane,
                const Options& options, SurfaceWork& work) {
  auto& [mesh, report] = work.conversion;
  report.layer_quads = layers.quads;
  report.regions = layers.regions;
  report.odd_regions = layers.odd_regions;
  auto& stages = work.record.stages;
  if (wants_stages(options)) {
    stages.resize(kStages, mesh);  // of nothing, if nothing was left
    stages.front() = as_it_was(patch);
    if (plane) work.record.normal = plane->normal();
  }
  const auto mend_sources = [&](QuadMesh& one) {
    for (Index& source : one.source)
      if (source != kNone && source >= patch.points.size()) source = kNone;  // in the middle of a column
  };
  mend_sources(mesh);
  std::for_each(stages.begin(), stages.end(), mend_sources);
}

/// Marks the nodes of regions that are grids of cells that are no layers'. Whether there are any.
bool mark_grids(const Surface& surface, std::vector<bool>& nodes) {
  bool is_any = false;
  for (const Region& region : surface.regions) {
    if (!is_unstretched_grid(kernel::Mesh(region.points, region.triangles, region.open))) continue;
    is_any = true;
    for (Index v : region.node) nodes[v] = true;
  }
  return is_any;
}

/// Nothing where no valid quads are found for a region beside layers; its nodes are marked in `stuck` then.
std::optional<SurfaceWork> convert_beside(const layers::Layers& layers, const Patch& patch,
                                          const std::optional<Plane>& plane, const Options& options, Budget& budget,
                                          std::vector<bool>& stuck) {
  std::vector<bool> stuck_now(layers.patch.points.size(), false);
  SurfaceWork work = convert_triangles(layers.patch, plane, options, budget, &stuck_now);
  if (std::find(stuck_now.begin(), stuck_now.end(), true) == stuck_now.end()) {
    add_layers(patch, layers, plane, options, work);
    return work;
  }
  for (std::size_t v = 0; v < stuck.size(); ++v) stuck[v] = stuck[v] || stuck_now[v];
  return {};
}

/// Where two layers end close to each other the front may have room for poor quads only. A few cells there are left to
/// the front as well, if that makes it better.
void give_up_narrow_cells(const layers::Layers& layers, const Patch& patch, const std::optional<Plane>& plane,
                          const Options& options, Budget& budget, std::vector<bool> without, SurfaceWork& work) {
  constexpr double kMostCells = 0.01, kMuch = 0.02, kLittle = 0.005;
  const auto meetings_of = [&](const layers::Layers& some, const SurfaceWork& result) {
    return layers::look_at_meetings(some, patch.quads.size(), result.conversion.mesh);
  };
  const layers::Meetings before = meetings_of(layers, work);
  if (before.narrow_nodes.empty()) return;
  for (Index v : before.narrow_nodes) without[v] = true;
  const auto fewer = layers::find_layers(patch, without, space::crease_angle_of(patch, options.crease_angle));
  if (!fewer || double(fewer->quads) < (1 - kMostCells) * double(layers.quads)) return;
  Options again = options;
  if (options.progress) again.progress = [&](std::string_view stage, double) { return options.progress(stage, 1); };
  std::optional<SurfaceWork> other;
  try {
    other = convert_beside(*fewer, patch, plane, again, budget, without);
  } catch (const SurfaceError&) {  // it was valid with more
  }
  if (!other || other->conversion.mesh.triangles.size() > work.conversion.mesh.triangles.size()) return;
  const layers::Meetings after = meetings_of(*fewer, *other);
  const bool is_better = after.poor < before.poor || after.least > before.least + kMuch;
  // The budget may have been spent on the poor ones, and what is left makes the others worse.
  const bool is_worse = after.poor > before.poor || after.least < before.least || after.mean < before.mean - kLittle;
  if (is_better && !is_worse) work = std::move(*other);
}

}  // namespace

SurfaceWork convert_with_layers(const Patch& patch, const std::optional<Plane>& plane, const Options& options,
                                Budget& budget) {
  constexpr int kTries = 2;
  std::vector<bool> stuck(patch.points.size(), false);
  for (int i = 0; options.layers && i < kTries; ++i) {
    const auto layers = layers::find_layers(patch, stuck, space::crease_angle_of(patch, options.crease_angle));
    if (!layers) break;
    if (plane && i == 0) {
      const Surface whole(patch, *plane);
      require_fronts(whole.regions, *plane);
      require_no_overlap(whole.regions, *plane);
      if (!layers->patch.triangles.empty() && mark_grids(whole, stuck)) continue;
    }
    auto work = convert_beside(*layers, patch, plane, options, budget, stuck);
    if (!work) continue;
    give_up_narrow_cells(*layers, patch, plane, options, budget, stuck, *work);
    return std::move(*work);
  }
  return convert_triangles(patch, plane, options, budget, nullptr);
}

}  // namespace qmorph
