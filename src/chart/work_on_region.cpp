// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/work_on_region.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "chart/interfaces.hpp"
#include "chart/irregular_nodes.hpp"
#include "chart/topology.hpp"
#include "chart/window_work.hpp"
#include "chart/windows.hpp"
#include "engine/allowance.hpp"
#include "parallel/for_each.hpp"
#include "parallel/shared_progress.hpp"
#include "qmorph/error.hpp"
#include "space/improve.hpp"

namespace qmorph::chart {
namespace {

/// Faces of a chart: larger ones cost more than they are worth.
constexpr std::size_t kMostOfChart = 60'000;
constexpr WindowSize kCleaningWindow{8, 5, 800, true};
constexpr WindowSize kCancellingWindow{14, 9, 1500, true};

using Work = std::optional<Reworked> (*)(const LaidOut& window, const Options& options,
                                         const space::Background& background);

class Worker {
 public:
  Worker(const CurvedRegion& region, const Options& options, double allowed, Task task)
      : region_(region), options_(options), allowed_(allowed), task_(task), mesh_(region.start()) {
    options_.part_triangles = 0;  // parts have been cut already
    if (region.region.triangles.size() > 2 * options.retry_triangles) options_.retry_triangles = 0;  // as in a plane
  }

  RegionWork run() {
    if (wants_stages(options_)) work_.stages.assign(kStages - 1, mesh_);
    divide_region();
    work_on_parts();
    clean_interfaces();
    work_.mesh = improved();
    return std::move(work_);
  }

 private:
  const space::Background& background() const { return *region_.background; }

  SurfaceMesh improve(SurfaceMesh mesh) const {
    return space::improve(std::move(mesh), creases_, region_, options_.smoothing);
  }

  /// What is valid in a window may have no valid place in space.
  SurfaceMesh improved() {
    const SurfaceMesh before = mesh_;
    if (task_ == Task::convert && cancel_irregular_nodes()) {
      try {
        return improve(std::move(mesh_));
      } catch (const SurfaceError&) {
      }
    }
    return improve(before);
  }

  void divide_region() {
    opposite_ = opposite_sides(mesh_);
    const std::vector<bool> is_crease = sides_on(mesh_, region_.creases);
    creases_ = edges_on(mesh_, is_crease);
    division_ = divide(mesh_, opposite_, is_crease, kMostOfChart);
    std::vector<bool> is_interface = division_.is_cut;
    for (std::size_t side = 0; side < is_interface.size(); ++side)
      if (is_crease[side]) is_interface[side] = false;
    interface_ = edges_on(mesh_, is_interface);
    // Between quads that are there already an interface is as good as it can be.
    if (!interface_.empty() && task_ == Task::convert) straighten_interfaces();
    const std::vector<char> changed = make_parts_even(mesh_, opposite_, division_, creases_, interface_, background());
    for (Index p = 0; p < division_.parts.size(); ++p)
      if (changed[p] || !division_.laid_out[p])
        division_.laid_out[p] = std::make_unique<LaidOut>(mesh_, opposite_, division_.is_cut, division_.parts[p]);
  }

  void straighten_interfaces() {
    straighten(mesh_, creases_, interface_, background());
    opposite_ = opposite_sides(mesh_);
    division_.is_cut = sides_on(mesh_, interface_);
    const std::vector<bool> is_crease = sides_on(mesh_, creases_);
    for (std::size_t side = 0; side < is_crease.size(); ++side)
      if (is_crease[side]) division_.is_cut[side] = true;
    std::vector<Index> all(mesh_.faces.size());
    std::iota(all.begin(), all.end(), 0);
    division_.parts = components(all, opposite_, division_.is_cut);
    division_.laid_out.clear();
    division_.laid_out.resize(division_.parts.size());
  }

  void work_on_parts() {
    const std::size_t parts = division_.parts.size();
    std::vector<Reworked> results(parts);
    std::vector<ConversionReport> reports(parts);
    std::vector<Record> records(parts);
    const parallel::SharedProgress shared(options_.progress, double(mesh_.faces.size()));
    std::vector<ProgressCallback> progress;
    for (const auto& part : division_.parts) progress.push_back(shared.part(double(part.size())));
    parallel::for_each_index(parts, [&](std::size_t p) {
      if (shared.is_over()) return;
      Options own = options_;
      own.progress = progress[p];
      const double most =
          part_of(allowed_, double(division_.parts[p].size()), double(mesh_.faces.size()), parts);
      const LaidOut& part = *division_.laid_out[p];
      results[p] = {&part.piece, work_on_part(part, own, most, task_, reports[p], records[p]), {}};
      results[p].lifted = lift(results[p].mesh, part.piece, part.chart, background());
    });
    shared.finish();
    for (std::size_t p = 0; p < parts; ++p) {
      work_.report.add(reports[p]);
      work_.cost += double(results[p].mesh.work());
      for (std::size_t i = 0; i < kStages; ++i) work_.seconds[i] += records[p].seconds[i];
      for (auto& front : records[p].fronts) work_.fronts.push_back(std::move(front));
    }
    for (std::size_t stage = 1; stage < work_.stages.size(); ++stage) work_.stages[stage] = at_stage(stage, records);
    mesh_ = replace(mesh_, results);
  }

  /// The region as its parts were after a stage, or after the last one before it that was run.
  SurfaceMesh at_stage(std::size_t stage, const std::vector<Record>& records) const {
    std::vector<Reworked> parts;
    for (std::size_t p = 0; p < records.size(); ++p) {
      std::size_t last = stage;
      while (!records[p].stages[last]) --last;  // the input is always there
      const LaidOut& part = *division_.laid_out[p];
      parts.push_back({&part.piece, *records[p].stages[last], {}});
      parts.back().lifted = lift(parts.back().mesh, part.piece, part.chart, background());
    }
    return replace(mesh_, parts);
  }

  /// Interfaces were boundaries: irregular nodes beside them cancel now, and rows run straight on.
  void clean_interfaces() {
    if (interface_.empty()) return;
    std::vector<char> waiting(mesh_.points.size(), 0);
    for (const auto& [a, b] : interface_) waiting[a] = waiting[b] = 1;
    work_in_windows(std::move(waiting), kCleaningWindow, clean_window);
  }

  /// True if it has changed the mesh. Windows cover all of it soon: where it is large, or has few irregular nodes, they cost more than they are worth.
  bool cancel_irregular_nodes() {
    constexpr int kPasses = 3;  // those that are gone make room for others to cancel
    constexpr std::size_t kLarge = 20'000;
    bool changed = false;
    for (int pass = 0; pass < kPasses && mesh_.faces.size() < kLarge; ++pass) {
      std::vector<char> irregular = irregular_nodes(mesh_, creases_);
      const auto count = std::count(irregular.begin(), irregular.end(), 1);
      if (double(count) < kFewIrregular * double(mesh_.faces.size())) break;
      if (!work_in_windows(std::move(irregular), kCancellingWindow, cancel_in_window)) break;
      changed = true;
    }
    return changed;
  }

  /// True if a window has changed.
  bool work_in_windows(std::vector<char> waiting, const WindowSize& size, Work work) {
    bool changed = false;
    while (true) {
      waiting.resize(mesh_.points.size(), 0);
      opposite_ = opposite_sides(mesh_);
      const std::vector<Window> windows =
          take_windows(mesh_, opposite_, sides_on(mesh_, creases_), size, waiting);
      if (windows.empty()) return changed;
      std::vector<std::optional<Reworked>> reworked(windows.size());
      parallel::for_each_index(windows.size(), [&](std::size_t w) {
        reworked[w] = work(*windows[w].laid_out, options_, background());
      });
      std::vector<Reworked> results;
      for (auto& window : reworked)
        if (window) results.push_back(std::move(*window));
      changed = changed || !results.empty();
      mesh_ = replace(mesh_, results);
    }
  }

  const CurvedRegion& region_;
  Options options_;
  const double allowed_;
  const Task task_;
  RegionWork work_;
  SurfaceMesh mesh_;
  std::vector<Index> opposite_;
  std::vector<Edge> creases_, interface_;
  Division division_;
};

}  // namespace

RegionWork work_on_region(const CurvedRegion& region, const Options& options, double allowed, Task task) {
  return Worker(region, options, allowed, task).run();
}

}  // namespace qmorph::chart
