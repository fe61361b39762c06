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

/// Whether there are fewer poor quads, or the worst is much better, and nothing is worse for it: the budget may have
/// been spent on the poor ones, and what is left makes the others worse.
bool is_better(const layers::Shapes& after, const layers::Shapes& before) {
  constexpr double kMuch = 0.02, kLittle = 0.005;
  const bool is_worse = after.poor > before.poor || after.least < before.least || after.mean < before.mean - kLittle;
  return !is_worse && (after.poor < before.poor || after.least > before.least + kMuch);
}

/// Whether that is worth what layers lose.
bool is_far_better(const layers::Shapes& after, const layers::Shapes& before) {
  constexpr double kLittle = 0.02;
  return 2 * after.poor <= before.poor && after.least >= before.least && after.mean >= before.mean - kLittle;
}

/// A result with layers, of which a few cells are left to the front as well if that makes it better.
class Concessions {
 public:
  /// \param without nodes around which nothing is a layer already
  Concessions(const Patch& patch, const std::optional<Plane>& plane, const Options& options, Budget& budget,
              std::vector<bool> without, layers::Layers layers, SurfaceWork work)
      : patch_(patch),
        plane_(plane),
        options_(options),
        budget_(budget),
        without_(std::move(without)),
        layers_(std::move(layers)),
        work_(std::move(work)),
        meetings_(meetings_of(layers_, work_)) {
    if (options.progress)
      options_.progress = [&options](std::string_view stage, double) { return options.progress(stage, 1); };
  }

  SurfaceWork make() {
    constexpr double kMostNarrow = 0.01, kMostSlanting = 0.2;  // shares of the cells
    const double all = double(layers_.quads);
    // Where two layers end close to each other the front may have room for poor quads only.
    leave_out(meetings_.narrow_nodes, kMostNarrow * all,
              [](const layers::Meetings& after, const layers::Meetings& before) {
                return is_better(after.of_front, before.of_front);
              });
    // Cells slant where a layer ends at a curve, or at a sharp corner without a fan.
    leave_out(meetings_.slanting_nodes, kMostSlanting * all,
              [](const layers::Meetings& after, const layers::Meetings& before) {
                return is_far_better(after.of_all, before.of_all);
              });
    return std::move(work_);
  }

 private:
  layers::Meetings meetings_of(const layers::Layers& layers, const SurfaceWork& work) const {
    return layers::look_at_meetings(layers, patch_.quads.size(), work.conversion.mesh);
  }

  /// The cells at the nodes, if they are not more than `most` and pays(meetings after, meetings before).
  template <class Pays>
  void leave_out(const std::vector<Index>& nodes, double most, const Pays& pays) {
    constexpr double kLeastBudget = 0.25;  // of the surface's: with less, what is new would not be finished
    if (nodes.empty()) return;
    std::vector<bool> without = without_;
    for (Index v : nodes) without[v] = true;
    auto fewer = layers::find_layers(patch_, without, space::crease_angle_of(patch_, options_.crease_angle));
    if (!fewer || double(fewer->quads) < double(layers_.quads) - most) return;
    Budget own(std::max(budget_.left(), kLeastBudget * budget_.allowed()));
    std::optional<SurfaceWork> other;
    try {
      std::vector<bool> stuck = without;
      other = convert_beside(*fewer, patch_, plane_, options_, own, stuck);
    } catch (const SurfaceError&) {  // it was valid with more
    }
    budget_.spend(own.spent());
    if (!other || other->conversion.mesh.triangles.size() > work_.conversion.mesh.triangles.size()) return;
    layers::Meetings after = meetings_of(*fewer, *other);
    if (!pays(after, meetings_)) return;
    without_ = std::move(without);
    layers_ = std::move(*fewer);
    work_ = std::move(*other);
    meetings_ = std::move(after);
  }

  const Patch& patch_;
  const std::optional<Plane>& plane_;
  Options options_;
  Budget& budget_;
  std::vector<bool> without_;
  layers::Layers layers_;
  SurfaceWork work_;
  layers::Meetings meetings_;
};

}  // namespace

SurfaceWork convert_with_layers(const Patch& patch, const std::optional<Plane>& plane, const Options& options,
                                Budget& budget) {
  constexpr int kTries = 2;
  std::vector<bool> stuck(patch.points.size(), false);
  for (int i = 0; options.layers && i < kTries; ++i) {
    auto layers = layers::find_layers(patch, stuck, space::crease_angle_of(patch, options.crease_angle));
    if (!layers) break;
    if (plane && i == 0) {
      const Surface whole(patch, *plane);
      require_fronts(whole.regions, *plane);
      require_no_overlap(whole.regions, *plane);
      if (!layers->patch.triangles.empty() && mark_grids(whole, stuck)) continue;
    }
    auto work = convert_beside(*layers, patch, plane, options, budget, stuck);
    if (!work) continue;
    return Concessions(patch, plane, options, budget, std::move(stuck), std::move(*layers), std::move(*work)).make();
  }
  return convert_triangles(patch, plane, options, budget, nullptr);
}

}  // namespace qmorph
