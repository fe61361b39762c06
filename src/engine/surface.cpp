// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/surface.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <utility>

#include "engine/budget.hpp"
#include "engine/canonical/work.hpp"
#include "engine/collector.hpp"
#include "parallel/for_each.hpp"
#include "parallel/shared_progress.hpp"
#include "qmorph/error.hpp"
#include "quality/directed_size.hpp"
#include "quality/size_ratio.hpp"

namespace qmorph {
namespace {

/// The surface as it was after a stage, or after the last one before it that was run.
QuadMesh at_stage(const Surface& surface, const std::vector<Record>& regions, std::size_t stage) {
  Collector collector(surface.patch, surface.plane, surface.plane_points);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    std::size_t last = stage;
    while (!regions[r].stages[last]) --last;  // the input is always there
    collector.add(surface.regions[r], *regions[r].stages[last]);
  }
  return collector.finish();
}

SurfaceRecord record_of(const Surface& surface, const Options& options, std::vector<Record>& regions) {
  SurfaceRecord record;
  for (Record& region : regions) {
    for (std::size_t i = 0; i < kStages; ++i) record.seconds[i] += region.seconds[i];
    for (auto& front : region.fronts) record.fronts.push_back(std::move(front));
  }
  if (!wants_stages(options)) return record;
  record.normal = surface.plane.normal();
  for (std::size_t i = 0; i < kStages; ++i) record.stages.push_back(at_stage(surface, regions, i));
  return record;
}

/// Triangles that it has, or could have.
double weight(const Patch& patch) { return double(patch.triangles.size() + 2 * patch.quads.size()); }

/// An error about a place at which the region has a node is about that node.
SurfaceError with_node(const SurfaceError& error, const Surface& surface, const Region& region) {
  ErrorDetails details = error.details();
  if (details.subject || !details.place) return error;
  constexpr double kRounding = 1e-12;
  const Vec2 place = surface.plane.to_plane(*details.place);
  const auto distance = [&](Index v) { return (region.points[v] - place).squaredNorm(); };
  Index nearest = 0, farthest = 0;
  for (Index v = 0; v < region.points.size(); ++v) {
    if (distance(v) < distance(nearest)) nearest = v;
    if (distance(v) > distance(farthest)) farthest = v;
  }
  if (distance(nearest) > kRounding * kRounding * distance(farthest)) return error;
  details.subject = node_row(region.node[nearest]);
  details.place = surface.patch.points[region.node[nearest]];
  return SurfaceError(error.what(), details);
}

SurfaceWork work_and_measure(const Patch& patch, const Options& options, Budget& budget, const PatchWork& work) {
  SurfaceWork result = canonical::work_on_numbered(patch, options, budget, work);
  const QuadMesh& mesh = result.conversion.mesh;
  result.conversion.report.sizes = directed_sizes(patch, mesh.points, mesh.quads);
  if (wants_stages(options)) result.record.size_ratios = size_ratios(patch, mesh);
  return result;
}

}  // namespace

Surface::Surface(const Patch& surface, const Plane& its_plane) : patch(surface), plane(its_plane) {
  plane_points.reserve(patch.points.size());
  for (const auto& p : patch.points) plane_points.push_back(plane.to_plane(p));
  regions = cut_into_regions(patch, plane_points);
}

namespace {

/// What has become of regions, by region.
struct RegionResults {
  std::vector<kernel::Mesh> meshes;
  std::vector<ConversionReport> reports;
  std::vector<Record> records;

  explicit RegionResults(std::size_t regions) : meshes(regions), reports(regions), records(regions) {}
  /// Replaces what there was; not if it throws.
  void make(std::size_t r, const Options& options, Budget& budget, const Work& work) {
    ConversionReport report;
    Record record;
    meshes[r] = work(r, options, budget, report, record);
    reports[r] = std::move(report), records[r] = std::move(record);
  }
};

/// What some regions leave of the budget is for those whose improvement was cut short, which begin again.
RegionResults make_all(const Surface& surface, const Options& options, Budget& budget, const Work& work) {
  RegionResults results(surface.regions.size());
  std::vector<ProgressCallback> progress;
  const std::size_t triangles = surface.patch.triangles.size();
  const parallel::SharedProgress shared(options.progress, double(triangles));
  std::vector<Budget> budgets;
  const double allowed = std::min(allowance(triangles), budget.left_for_another());
  for (const Region& region : surface.regions) {
    const auto size = double(region.triangles.size());
    progress.push_back(shared.part(size));
    budgets.emplace_back(share_of(allowed, size, double(triangles), surface.regions.size()));
  }
  const SpentInAll spent_in_all(budget, budgets);
  const auto make = [&](std::size_t r, const ProgressCallback& its_progress) {
    if (shared.is_over()) return;
    Options own = options;
    own.progress = its_progress;
    results.make(r, own, budgets[r], work);
  };
  parallel::for_each_index(surface.regions.size(), [&](std::size_t r) {
    try {
      make(r, progress[r]);
    } catch (const SurfaceError& error) {
      throw with_node(error, surface, surface.regions[r]);
    }
  });
  std::vector<std::size_t> cut_short;
  for (const ConversionReport& report : results.reports) cut_short.push_back(report.budgets_spent);
  const std::vector<std::size_t> again = share_out_the_rest(budgets, cut_short);
  parallel::for_each_index(again.size(), [&](std::size_t k) {
    try {
      make(again[k], {});
    } catch (const SurfaceError&) {  // it was valid with less
    }
  });
  shared.finish();
  return results;
}

}  // namespace

SurfaceWork work_on_regions(const Surface& surface, const Options& options, Budget& budget, const Work& work) {
  RegionResults results = make_all(surface, options, budget, work);
  SurfaceWork result;
  ConversionReport& report = result.conversion.report;
  Collector collector(surface.patch, surface.plane, surface.plane_points);
  for (std::size_t r = 0; r < results.meshes.size(); ++r) {
    report.add(results.reports[r]);
    ++report.regions;
    report.odd_regions += surface.regions[r].boundary_sides % 2;
    collector.add(surface.regions[r], results.meshes[r]);
  }
  result.conversion.mesh = collector.finish();
  if (options.observer) result.record = record_of(surface, options, results.records);
  return result;
}

Conversion work_on_patch(const Patch& patch, const Options& options, const PatchWork& work) {
  SurfaceWork result;
  Budget budget(budget_of_call(weight(patch)));
  parallel::with_threads(options.threads, [&] { result = work_and_measure(patch, options, budget, work); });
  if (options.observer) result.record.tell(*options.observer, 0);
  return std::move(result.conversion);
}

namespace {

/// Surfaces side by side.
class Patches {
 public:
  Patches(const std::vector<const Patch*>& patches, const Options& options, const PatchWork& work,
          std::optional<double> allowed)
      : patches_(patches), options_(options), work_(work), outcomes_(patches.size()), records_(patches.size()) {
    double total = 0;
    for (const Patch* patch : patches) total += weight(*patch);
    shared_ = parallel::SharedProgress(options.progress, total);
    for (const Patch* patch : patches) {
      progress_.push_back(shared_.part(weight(*patch)));
      budgets_.emplace_back(share_of(allowed.value_or(budget_of_call(total)), weight(*patch), total, patches.size()));
    }
  }

  std::vector<Outcome> run() {
    parallel::with_threads(options_.threads, [&] {
      parallel::for_each_index(patches_.size(), [&](std::size_t i) { work_on(i, progress_[i]); });
      const std::vector<std::size_t> again = share_out_the_rest(budgets_, cut_short());
      parallel::for_each_index(again.size(), [&](std::size_t k) {
        const ProgressCallback& progress = progress_[again[k]];
        work_on(again[k], progress ? [&](std::string_view stage, double) { return progress(stage, 1); } : progress);
      });
    });
    shared_.finish();
    for (std::size_t i = 0; options_.observer && i < patches_.size(); ++i) records_[i].tell(*options_.observer, i);
    return std::move(outcomes_);
  }

 private:
  /// How often the improvement of each was cut short; 0 where more would not help.
  std::vector<std::size_t> cut_short() const {
    std::vector<std::size_t> result(patches_.size(), 0);
    for (std::size_t i = 0; i < patches_.size(); ++i)
      if (could_use_more(i)) result[i] = 1 + outcomes_[i].conversion->report.budgets_spent;
    return result;
  }

  bool could_use_more(std::size_t i) const {
    constexpr double kNearlyAll = 0.7;
    const Budget& budget = budgets_[i];
    if (!outcomes_[i].conversion || budget.allowed() >= allowance(std::size_t(weight(*patches_[i])))) return false;
    return budget.spent() > kNearlyAll * budget.allowed() || outcomes_[i].conversion->report.budgets_spent > 0;
  }

  void work_on(std::size_t i, const ProgressCallback& progress) {
    using Clock = std::chrono::steady_clock;
    if (shared_.is_over()) return;
    const Clock::time_point start = Clock::now();
    Options own = options_;
    if (progress) own.progress = std::ref(progress);
    std::optional<NumberedObserver> numbered;
    if (options_.observer) own.observer = &numbered.emplace(*options_.observer, i);
    try {
      SurfaceWork result = work_and_measure(*patches_[i], own, budgets_[i], work_);
      outcomes_[i].conversion = std::move(result.conversion);
      records_[i] = std::move(result.record);
    } catch (const SurfaceError& error) {
      if (!outcomes_[i].conversion) outcomes_[i].error = error;
    }
    outcomes_[i].seconds += std::chrono::duration<double>(Clock::now() - start).count();
  }

  const std::vector<const Patch*>& patches_;
  const Options& options_;
  const PatchWork& work_;
  std::vector<Outcome> outcomes_;
  std::vector<SurfaceRecord> records_;
  parallel::SharedProgress shared_{{}, 0};
  std::vector<ProgressCallback> progress_;
  std::vector<Budget> budgets_;
};

}  // namespace

std::vector<Outcome> work_on_patches(const std::vector<const Patch*>& patches, const Options& options,
                                     const PatchWork& work, std::optional<double> allowed) {
  return Patches(patches, options, work, allowed).run();
}

}  // namespace qmorph
