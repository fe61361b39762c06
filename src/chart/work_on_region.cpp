// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/work_on_region.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "chart/region_try.hpp"
#include "engine/front_variants.hpp"

namespace qmorph::chart {
namespace {

/// Of what several tries have made, that with the fewest doubtful elements.
struct Best {
  std::optional<RegionWork> work;
  std::size_t doubtful = 0;

  void consider(RegionTry& attempt) {
    if (work && attempt.doubtful() >= doubtful) return;
    doubtful = attempt.doubtful();
    work = attempt.result();
  }
};

}  // namespace

bool has_more_for(const Budget& budget, std::size_t triangles, double times) {
  constexpr double kTries = 4, kTriesOfSmall = 8;  // in allowances; the first try takes two or three
  constexpr std::size_t kSmall = 2000;
  return !budget.is_spent() &&
         budget.spent() < times * (triangles <= kSmall ? kTriesOfSmall : kTries) * allowance(triangles);
}

RegionWork work_on_region(const CurvedRegion& region, const Options& options, Budget& budget, Task task,
                          SharedDivision& shared) {
  constexpr int kTries = 4;
  constexpr std::size_t kFew = 50;  // so that it is worth all of them
  const std::size_t size = region.region.triangles.size();
  Distrust distrust;
  std::optional<SurfaceError> first;
  Best best;
  for (int i = 1; i <= kTries; ++i) {
    if (best.work && !has_more_for(budget, size)) break;
    distrust.all = distrust.all || i == kTries || !has_more_for(budget, size);
    RegionTry attempt(region, options, budget, task, distrust, shared);
    if (attempt.run()) {
      const bool is_new = attempt.learn(distrust);
      best.consider(attempt);
      if (best.doubtful == 0 || !is_new || size > kSmallRegion) break;
    } else {
      if (!first) first = attempt.find_fault();
      distrust.fewest_turned = std::min(distrust.fewest_turned, attempt.turned());
      const std::size_t most_turned = size > kSmallRegion ? kFewTurned : kManyTurned;
      if (distrust.all || (attempt.turned() > most_turned && !has_more_for(budget, size))) break;
      if (!attempt.learn(distrust)) distrust.all = true;
    }
    distrust.interfaces = true;
  }
  if (best.work && (best.doubtful == 0 || size > kFew)) return std::move(*best.work);
  // What is valid in a chart may have no valid place on a surface that turns sharply; what another front makes may have
  // one, if there are few such places.
  const bool is_hopeful = task == Task::convert && (best.work || distrust.fewest_turned <= kFewTurned);
  if (is_hopeful && size <= options.retry_triangles) {
    const Distrust nothing;
    for (const Options& variant : few_front_variants(options)) {
      if (!has_more_for(budget, size)) break;
      RegionTry attempt(region, variant, budget, task, nothing, shared);
      if (!attempt.run()) continue;
      best.consider(attempt);
      if (best.doubtful == 0 || size > kFew) return std::move(*best.work);
    }
  }
  // A surface that nothing else makes valid may be so with nodes in the middles of its edges. There are many quads
  // then.
  constexpr std::size_t kNotMany = 2000, kCoarse = 200;
  const int refinings = size <= kFew && is_hopeful ? 3 : best.work || size > kNotMany ? 0 : size <= kCoarse ? 3 : 1;
  Distrust nodes;
  while (task == Task::convert && nodes.refinings++ < refinings && !(best.work && best.doubtful == 0) &&
         has_more_for(budget, size))
    if (RegionTry attempt(region, options, budget, task, nodes, shared); attempt.run()) best.consider(attempt);
  if (best.work) return std::move(*best.work);
  if (are_hopeless(distrust.fewest_turned, size)) throw HopelessRegion(first->what(), first->details());
  throw *first;
}

std::optional<RegionWork> try_region(const CurvedRegion& region, const Options& options, Budget& budget, Task task,
                                     SharedDivision& shared) {
  const Distrust nothing;
  RegionTry attempt(region, options, budget, task, nothing, shared, Tries::one);
  if (!attempt.run() || attempt.doubtful() > 0) return {};
  return attempt.result();
}

std::optional<RegionWork> try_grid(const CurvedRegion& region, const Options& options, Budget& budget,
                                   GridSizes sizes) {
  budget.spend(double(kWorkToBegin * region.region.triangles.size()));
  std::optional<SurfaceMesh> grid = lay_grid(region, sizes);
  if (!grid) return {};
  RegionWork work;
  if (wants_stages(options)) {
    work.stages.assign(kStages - 1, *grid);
    work.stages.front() = region.start();
  }
  const space::Faults faults = space::improve(*grid, {}, region, {}, options.smoothing);
  budget.spend(double(faults.work));
  if (!faults.turned.empty() || !faults.doubtful.empty()) return {};
  work.mesh = std::move(*grid);
  return work;
}

}  // namespace qmorph::chart
