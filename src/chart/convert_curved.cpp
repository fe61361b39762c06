// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/convert_curved.hpp"

#include <utility>

#include "chart/attempts.hpp"
#include "chart/collect.hpp"
#include "parallel/for_each.hpp"
#include "parallel/shared_progress.hpp"
#include "qmorph/error.hpp"
#include "space/creases.hpp"
#include "space/faults.hpp"
#include "space/put_right.hpp"
#include "space/reference.hpp"

namespace qmorph::chart {
namespace {

std::vector<RegionWork> work_on_all(const Patch& kept, const std::vector<CurvedRegion>& regions, const Options& options,
                                    Task task, Budget& budget, std::vector<bool>* stuck) {
  std::vector<char> is_stuck(regions.size(), 0);
  std::vector<RegionWork> works(regions.size());
  std::size_t total = 0;
  for (const CurvedRegion& region : regions) total += region.region.triangles.size();
  const parallel::SharedProgress shared(options.progress, double(total));
  std::vector<ProgressCallback> progress;
  std::vector<Budget> budgets;
  for (const CurvedRegion& region : regions) {
    const auto size = double(region.region.triangles.size());
    progress.push_back(shared.part(size));
    budgets.emplace_back(share_of(budget.left_for_another(), size, double(total), regions.size()));
  }
  const SpentInAll spent_in_all(budget, budgets);
  const auto best = [&](std::size_t r, const Options& own) {
    if (!kept.is_smooth) return best_of_attempts(regions[r], own, budgets[r], task);
    CurvedRegion faceted(kept, regions[r].region, options.crease_angle);
    if (faceted.creases.empty()) return best_of_attempts(regions[r], own, budgets[r], task);
    faceted.beside = regions[r].beside;
    return best_with_or_without_creases(regions[r], faceted, own, budgets[r], task);
  };
  parallel::for_each_index(regions.size(), [&](std::size_t r) {
    if (shared.is_over()) return;
    Options own = options;
    own.progress = progress[r];
    try {
      works[r] = best(r, own);
    } catch (const HopelessRegion&) {
      throw;
    } catch (const SurfaceError&) {
      if (!stuck) throw;
      is_stuck[r] = 1;
      if (wants_stages(own)) works[r].stages.resize(kStages - 1);
    }
  });
  shared.finish();
  for (std::size_t r = 0; r < regions.size(); ++r)
    if (is_stuck[r])
      for (Index v : regions[r].region.node) (*stuck)[v] = true;
  return works;
}

SurfaceRecord record_of(const Patch& kept, const std::vector<CurvedRegion>& regions, const Options& options,
                        std::vector<RegionWork>& works) {
  SurfaceRecord record;
  record.normal.setZero();
  for (RegionWork& work : works) {
    for (std::size_t i = 0; i < kStages; ++i) record.seconds[i] += work.seconds[i];
    for (auto& front : work.fronts) record.fronts.push_back(std::move(front));
  }
  if (!wants_stages(options)) return record;
  for (std::size_t i = 0; i < kStages; ++i) {
    std::vector<const SurfaceMesh*> meshes;
    for (const RegionWork& work : works) meshes.push_back(i + 1 == kStages ? &work.mesh : &work.stages[i]);
    record.stages.push_back(collect(kept, regions, meshes));
  }
  return record;
}

/// `kept` has those quads of the patch that stay.
SurfaceWork work_on_curved(const Patch& kept, const std::vector<CurvedRegion>& regions, const Options& options,
                           Task task, Budget& budget, std::vector<bool>* stuck) {
  std::vector<RegionWork> works = work_on_all(kept, regions, options, task, budget, stuck);
  SurfaceWork result;
  std::vector<const SurfaceMesh*> meshes;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    meshes.push_back(&works[r].mesh);
    result.conversion.report.add(works[r].report);
    ++result.conversion.report.regions;
    result.conversion.report.odd_regions += regions[r].region.boundary_sides % 2;
  }
  result.conversion.mesh = collect(kept, regions, meshes);
  if (options.observer) result.record = record_of(kept, regions, options, works);
  return result;
}

}  // namespace

SurfaceWork convert_curved(const Patch& patch, const Options& options, Budget& budget, std::vector<bool>* stuck) {
  return work_on_curved(patch, curved_regions(patch, space::crease_angle_of(patch, options.crease_angle)), options,
                        Task::convert, budget, stuck);
}

namespace {

SurfaceWork improve_as_it_is(const Patch& patch, const Options& options, Budget& budget) {
  Patch halves = patch;
  if (!patch.quads.empty()) halves.triangles = space::Reference::with_halves(patch);
  halves.quads.clear();
  auto regions = curved_regions(halves, options.crease_angle, patch.triangles.size());
  const std::vector<char> unsure = space::unsure_ground(patch);
  if (!unsure.empty())
    for (CurvedRegion& region : regions)
      for (Index row : region.region.row) region.unsure.push_back(unsure[row]);
  return work_on_curved(halves, regions, options, Task::improve, budget, nullptr);
}

}  // namespace

void require_none_turned(const Patch& patch, const QuadMesh& mesh, std::size_t kept,
                         std::vector<space::Suspect> suspects) {
  if (const auto defect = space::find_turned(patch, mesh, kept, std::move(suspects)))
    throw SurfaceError(defect->what +
                           ", and no place was found for its nodes where it is not; mesh the surface anew "
                           "or repair it",
                       {.kind = ErrorKind::bad_element, .place = defect->place});
}

namespace {

void require_none_turned_in(const Patch& patch, const QuadMesh& mesh, std::size_t kept) {
  require_none_turned(patch, mesh, kept, space::find_suspects(patch, mesh, kept));
}

}  // namespace

std::optional<SurfaceWork> work_put_right(const Patch& patch, std::size_t kept, const Options& options,
                                          const CurvedWork& work) {
  const std::optional<Patch> right = space::put_right(patch, kept, options.crease_angle);
  if (!right) return {};
  try {
    SurfaceWork result = work(*right);
    QuadMesh& mesh = result.conversion.mesh;
    require_none_turned_in(*right, mesh, kept);
    space::lay_onto(patch, mesh);
    require_none_turned_in(patch, mesh, kept);
    if (!result.record.stages.empty()) result.record.stages.back() = mesh;
    return result;
  } catch (const SurfaceError&) {
    return {};
  }
}

SurfaceWork improve_curved(const Patch& patch, const Options& options, Budget& budget) {
  const auto work = [&](const Patch& one) { return improve_as_it_is(one, options, budget); };
  if (auto result = work_put_right(patch, 0, options, work)) return std::move(*result);
  SurfaceWork result = work(patch);
  require_none_turned_in(patch, result.conversion.mesh, 0);
  return result;
}

}  // namespace qmorph::chart
