// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/attempts.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "chart/irregular_nodes.hpp"
#include "engine/front_variants.hpp"
#include "engine/worth.hpp"
#include "qmorph/error.hpp"
#include "space/improve.hpp"

namespace qmorph::chart {
namespace {

/// What fails is worth one try more; these give a result each.
constexpr double kTimes = 2.5;

/// The first of those that add most to each other in the plane.
std::vector<Options> with_other_fronts(const Options& asked) {
  constexpr std::size_t kTries = 3;
  std::vector<Options> variants = front_variants(asked);
  variants.resize(std::min(variants.size(), kTries));
  return variants;
}

struct Worth {
  double irregular = 0;  ///< irregular nodes a face
  double least = 1;      ///< smallest scaled Jacobian of a quad
  double sum = 0;        ///< regular nodes count for more than good shapes, and both for more than one poor element

  Worth(const SurfaceMesh& mesh, std::size_t triangles) {
    const std::vector<char> is_irregular = irregular_nodes(mesh, {});
    const double faces = double(mesh.faces.size());
    irregular = double(std::count(is_irregular.begin(), is_irregular.end(), 1)) / faces;
    double mean = 0;
    for (const Face& face : mesh.faces) {
      const double sine = own_sine(mesh, face);
      if (degree(face) == 4) least = std::min(least, sine);
      mean += sine / faces;
    }
    const double growth = kTrianglesPerQuad * faces / double(triangles);
    sum = std::min(least, qmorph::Worth::kGoodEnoughInChart) + 2 * mean - 3 * irregular -
          std::max(0.0, growth - kFairGrowth);
  }
};

/// \throws SurfaceError
RegionWork usual_or_grid(const CurvedRegion& region, const Options& options, Budget& budget, SharedDivision& shared) {
  try {
    return work_on_region(region, options, budget, Task::convert, shared);
  } catch (const SurfaceError&) {
    if (std::optional<RegionWork> grid = try_grid(region, options, budget, GridSizes::any)) return std::move(*grid);
    throw;
  }
}

}  // namespace

RegionWork best_of_attempts(const CurvedRegion& region, const Options& options, Budget& budget, Task task) {
  const std::size_t size = region.region.triangles.size();
  SharedDivision shared;
  if (task != Task::convert || size > 2 * options.retry_triangles)
    return work_on_region(region, options, budget, task, shared);
  RegionWork best = usual_or_grid(region, options, budget, shared);
  Worth worth(best.mesh, size);
  const auto take_if_better = [&](std::optional<RegionWork> work) {
    if (!work) return;
    const Worth other(work->mesh, size);
    if (worth.sum >= other.sum) return;
    best = std::move(*work);
    worth = other;
  };
  if (worth.irregular >= kFewIrregular || worth.least < kFair)
    take_if_better(try_grid(region, options, budget, GridSizes::as_triangles));
  for (const Options& variant : with_other_fronts(options)) {
    if (worth.irregular < kFewIrregular || !has_more_for(budget, size, kTimes)) break;
    take_if_better(try_region(region, variant, budget, task, shared));
  }
  return best;
}

RegionWork best_with_or_without_creases(const CurvedRegion& smooth, const CurvedRegion& faceted, const Options& options,
                                        Budget& budget, Task task) {
  const std::size_t size = smooth.region.triangles.size();
  std::optional<RegionWork> best;
  bool is_turned = false;  // as only what lies over a fold may be
  try {
    best = best_of_attempts(smooth, options, budget, task);
    is_turned = space::has_turned(best->mesh, smooth);
    const bool is_poor = is_turned || Worth(best->mesh, size).least < kRefused;
    if (size > 2 * options.retry_triangles || !(is_poor || has_more_for(budget, size, kTimes))) return std::move(*best);
  } catch (const SurfaceError&) {  // along the facets' edges elements have a place at least
  }
  try {
    // What failed, or came out poor, may have spent all that was allowed for both.
    std::vector<Budget> own{Budget(budget.left_for_another())};
    const SpentInAll spent_in_all(budget, own);
    RegionWork other = best_of_attempts(faceted, options, own.front(), task);
    const bool is_other_turned = best && space::has_turned(other.mesh, smooth);
    const bool is_better =
        best && (is_other_turned == is_turned ? Worth(other.mesh, size).sum > Worth(best->mesh, size).sum : is_turned);
    if (!best || is_better) best = std::move(other);
  } catch (const SurfaceError&) {
    if (!best) throw;
  }
  return std::move(*best);
}

}  // namespace qmorph::chart
