// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/surface.hpp"

#include <chrono>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/allowance.hpp"
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

SurfaceWork work_and_measure(const Patch& patch, const Options& options, double allowed, const PatchWork& work) {
  SurfaceWork result = work(patch, options, allowed);
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

SurfaceWork work_on_regions(const Surface& surface, const Options& options, double allowed, const Work& work) {
  std::vector<kernel::Mesh> meshes(surface.regions.size());
  std::vector<ConversionReport> reports(meshes.size());
  std::vector<Record> records(meshes.size());
  std::vector<ProgressCallback> progress;
  const double triangles = double(surface.patch.triangles.size());
  const parallel::SharedProgress shared(options.progress, triangles);
  for (const Region& region : surface.regions) progress.push_back(shared.part(double(region.triangles.size())));
  parallel::for_each_index(meshes.size(), [&](std::size_t r) {
    if (shared.is_over()) return;
    Options own = options;
    own.progress = progress[r];
    const double most = part_of(allowed, double(surface.regions[r].triangles.size()), triangles, meshes.size());
    try {
      meshes[r] = work(r, own, most, reports[r], records[r]);
    } catch (const SurfaceError& error) {
      throw with_node(error, surface, surface.regions[r]);
    }
  });
  shared.finish();

  SurfaceWork result;
  ConversionReport& report = result.conversion.report;
  Collector collector(surface.patch, surface.plane, surface.plane_points);
  for (std::size_t r = 0; r < meshes.size(); ++r) {
    report.add(reports[r]);
    ++report.regions;
    report.odd_regions += surface.regions[r].boundary_sides % 2;
    collector.add(surface.regions[r], meshes[r]);
    result.cost += double(meshes[r].work());
  }
  result.conversion.mesh = collector.finish();
  if (options.observer) result.record = record_of(surface, options, records);
  return result;
}

Conversion work_on_patch(const Patch& patch, const Options& options, const PatchWork& work) {
  SurfaceWork result;
  parallel::with_threads(options.threads,
                         [&] { result = work_and_measure(patch, options, allowance(weight(patch)), work); });
  if (options.observer) result.record.tell(*options.observer, 0);
  return std::move(result.conversion);
}

namespace {

/// Surfaces side by side, as often as it takes.
class Patches {
 public:
  Patches(const std::vector<const Patch*>& patches, const Options& options, const PatchWork& work)
      : patches_(patches), options_(options), work_(work), outcomes_(patches.size()), records_(patches.size()) {
    for (const Patch* patch : patches) total_ += weight(*patch);
    shared_ = parallel::SharedProgress(options.progress, total_);
    for (const Patch* patch : patches) progress_.push_back(shared_.part(weight(*patch)));
  }

  std::vector<Outcome> run() {
    const double most = allowance(total_);
    std::vector<double> allowed;
    for (const Patch* patch : patches_) allowed.push_back(part_of(most, weight(*patch), total_, patches_.size()));
    std::vector<std::size_t> all(patches_.size());
    std::iota(all.begin(), all.end(), std::size_t(0));
    work_on(all, allowed);
    // What most leave is for those for which their share was not enough.
    constexpr int kRounds = 2;
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<std::size_t> cut_off = those_cut_off();
      if (cut_off.empty() || cut_off.size() == patches_.size()) break;
      const double each = (most - cost_) / double(cut_off.size());
      std::vector<std::size_t> again;
      for (std::size_t i : cut_off)
        if (each > 2 * allowed[i]) again.push_back(i), allowed[i] = each;
      work_on(again, allowed);
    }
    shared_.finish();
    for (std::size_t i = 0; options_.observer && i < patches_.size(); ++i) records_[i].tell(*options_.observer, i);
    return std::move(outcomes_);
  }

 private:
  void work_on(const std::vector<std::size_t>& some, const std::vector<double>& allowed) {
    std::vector<double> costs(some.size(), 0);
    parallel::with_threads(options_.threads, [&] {
      parallel::for_each_index(some.size(), [&](std::size_t k) { costs[k] = work_on(some[k], allowed[some[k]]); });
    });
    for (double cost : costs) cost_ += cost;
  }

  /// Returns what it cost.
  double work_on(std::size_t i, double allowed) {
    using Clock = std::chrono::steady_clock;
    if (shared_.is_over()) return 0;
    const Clock::time_point start = Clock::now();
    Options own = options_;
    if (progress_[i]) own.progress = std::ref(progress_[i]);
    std::optional<NumberedObserver> numbered;
    if (options_.observer) own.observer = &numbered.emplace(*options_.observer, i);
    double cost = 0;
    try {
      SurfaceWork result = work_and_measure(*patches_[i], own, allowed, work_);
      outcomes_[i].conversion = std::move(result.conversion);
      records_[i] = std::move(result.record);
      cost = result.cost;
    } catch (const SurfaceError& error) {
      if (!outcomes_[i].conversion) outcomes_[i].error = error;
    }
    outcomes_[i].seconds += std::chrono::duration<double>(Clock::now() - start).count();
    return cost;
  }

  std::vector<std::size_t> those_cut_off() const {
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < outcomes_.size(); ++i)
      if (outcomes_[i].conversion && outcomes_[i].conversion->report.budgets_spent > 0) some.push_back(i);
    return some;
  }

  const std::vector<const Patch*>& patches_;
  const Options& options_;
  const PatchWork& work_;
  std::vector<Outcome> outcomes_;
  std::vector<SurfaceRecord> records_;
  double total_ = 0, cost_ = 0;
  parallel::SharedProgress shared_{{}, 0};
  std::vector<ProgressCallback> progress_;
};

}  // namespace

std::vector<Outcome> work_on_patches(const std::vector<const Patch*>& patches, const Options& options,
                                     const PatchWork& work) {
  return Patches(patches, options, work).run();
}

}  // namespace qmorph
