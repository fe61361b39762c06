// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/work_on_region.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "chart/divide_region.hpp"
#include "chart/irregular_nodes.hpp"
#include "chart/pair_up.hpp"
#include "chart/refine.hpp"
#include "chart/topology.hpp"
#include "chart/widen_tips.hpp"
#include "chart/window_work.hpp"
#include "chart/windows.hpp"
#include "engine/budget.hpp"
#include "engine/front_variants.hpp"
#include "geometry/describe.hpp"
#include "kernel/is_any.hpp"
#include "parallel/for_each.hpp"
#include "parallel/shared_progress.hpp"
#include "qmorph/error.hpp"
#include "space/improve.hpp"

namespace qmorph::chart {
namespace {

/// What everything that is not counted costs a try for each triangle: to divide, to flatten, to settle.
constexpr std::size_t kWorkToBegin = 120;
constexpr WindowSize kCleaningWindow{8, 5, 800, true};
constexpr WindowSize kCancellingWindow{14, 9, 1500, true};

/// With more elements turned over than this, the fault is not one of single places.
constexpr std::size_t kFewTurned = 4;
/// With more than this in a region that is not large, another try has failed as well, as good as always. Where parts
/// have no chart, some elements in a thousand are turned over, so that large regions fail with fewer.
constexpr std::size_t kManyTurned = 24;

using Work = WindowResult (*)(const LaidOut& window, const Options& options, const Ground& ground, double allowed);

/// Where a try has failed, by triangle of the region.
struct Distrust {
  std::vector<char> triangles;
  bool interfaces = false;  ///< straight ones were too much
  bool all = false;
  int refinings = 0;  ///< there are too few nodes
};

/// One try.
class Worker {
 public:
  Worker(const CurvedRegion& region, const Options& options, Budget& budget, Task task, const Distrust& distrust,
         SharedDivision& shared, Tries tries = Tries::as_many_as_pay)
      : region_(region),
        options_(options),
        budget_(budget),
        task_(task),
        distrust_(distrust),
        shared_(shared),
        tries_(tries),
        ground_{*region.background, may_stretch() ? region.stretch() : nullptr} {
    budget.spend(double(kWorkToBegin * region.region.triangles.size()));
    options_.part_triangles = 0;  // parts have been cut already
    if (region.region.triangles.size() > 2 * options.retry_triangles) options_.retry_triangles = 0;  // as in a plane
  }

  /// False if it failed.
  bool run() {
    if (wants_stages(options_)) work_.stages.assign(kStages - 1, started());
    divide();
    work_on_parts();
    clean_interfaces();
    const SurfaceMesh before = mesh_;
    if (task_ == Task::convert && cancel_irregular_nodes()) {
      const bool is_valid = improve();
      if (is_valid && doubtful() == 0) return true;
      // What is valid in a window may have no valid place in space.
      SurfaceMesh cancelled = std::exchange(mesh_, before);
      space::Faults faults = faults_;
      if (improve() && (!is_valid || doubtful() < faults.doubtful.size())) return true;
      if (is_valid) mesh_ = std::move(cancelled), faults_ = std::move(faults);
      return is_valid;
    }
    return improve();
  }

  RegionWork result() {
    work_.mesh = std::move(mesh_);
    return std::move(work_);
  }

  std::size_t doubtful() const { return faults_.doubtful.size(); }
  std::size_t turned() const { return faults_.turned.size(); }

  std::optional<SurfaceError> find_fault() const {
    const auto error_at = [&](Index f, const char* what, const char* why) {
      const Face& face = mesh_.faces[f];
      const Index v = *std::min_element(face.begin(), face.begin() + degree(face));  // of the input, if one is
      const Eigen::Vector3d& place = mesh_.points[v];
      ErrorDetails details{.kind = ErrorKind::no_valid_mesh, .place = place};
      if (v < region_.points.size()) details.subject = node_row(region_.region.node[v]);
      return SurfaceError(what + describe(place) + why + "; refine the triangles or the boundary there", details);
    };
    if (!faults_.turned.empty()) return error_at(faults_.turned[0], "no valid element was found at ", "");
    std::size_t triangles = 0;
    for (Index f = 0; f < mesh_.faces.size(); ++f)
      if (degree(mesh_.faces[f]) == 3 && ++triangles > region_.region.boundary_sides % 2)
        return error_at(f, "the triangle at ", " could not be removed");
    return {};
  }

  /// Adds what is under the faces that failed. False if that was distrusted already.
  bool learn(Distrust& distrust) const {
    bool is_new = false;
    distrust.triangles.resize(region_.region.triangles.size(), 0);
    const auto add = [&](Index triangle) {
      if (triangle != kNone && !distrust.triangles[triangle]) distrust.triangles[triangle] = 1, is_new = true;
    };
    for (const auto* faces : {&faults_.turned, &faults_.doubtful})
      for (Index f : *faces) {
        add(mesh_.near[f]);
        for (Index i = 0; i < degree(mesh_.faces[f]); ++i) add(mesh_.on[mesh_.faces[f][i]]);
      }
    return is_new;
  }

 private:
  const space::Background& background() const { return *region_.background; }

  SurfaceMesh started() const {
    SurfaceMesh mesh = region_.start();
    for (int i = 0; i < distrust_.refinings; ++i) mesh = refined(mesh, region_.creases);
    return mesh;
  }

  /// Work for each use of windows. Ordinary surfaces take a tenth of it, a double torus that is cut all over a half;
  /// without what it needs at its cuts a surface gets smaller quads, and more tries.
  double window_allowance() const {
    constexpr double kTimes = 8, kEach = 1800;
    const std::size_t size = region_.region.triangles.size();
    return kTimes * (allowance(size) + kEach * double(size));
  }

  /// Of all parts; interfaces and what space asks for need the rest. A try that has begun gets what it takes.
  double work_in_charts() const {
    constexpr double kShare = 0.5, kLeastEach = 500;
    const std::size_t size = region_.region.triangles.size();
    return std::min(allowance(size), std::max(kShare * budget_.left(), kLeastEach * double(size)));
  }

  /// What is refined here is as long as there were too few nodes.
  bool may_stretch() const { return task_ == Task::convert && options_.layers && distrust_.refinings == 0; }

  bool improve() {
    std::optional<SurfaceMesh> widened;
    if (task_ == Task::convert) widened = with_wider_tips(mesh_, divided_->creases, background());
    const bool is_valid = improve_as_it_is();
    if (!widened || turned() > kFewTurned) return is_valid;
    SurfaceMesh narrow = std::exchange(mesh_, std::move(*widened));
    space::Faults faults = faults_;
    const Budget before = budget_;
    const bool is_wider_valid = improve_as_it_is();
    budget_ = before;  // at most what improve() costs anyway: tries of other fronts need not pay for it
    if (is_wider_valid &&
        (!is_valid || (doubtful() <= faults.doubtful.size() && smallest_own_sine(mesh_) > smallest_own_sine(narrow))))
      return true;
    mesh_ = std::move(narrow), faults_ = std::move(faults);
    return is_valid;
  }

  bool improve_as_it_is() {
    faults_ = space::improve(mesh_, divided_->creases, region_, stretched_, options_.smoothing);
    budget_.spend(double(faults_.work));
    return !find_fault();
  }

  /// What nothing is distrusted of is the same for all fronts.
  void divide() {
    // Between existing quads an interface cannot be improved.
    const bool straightens = task_ == Task::convert && !distrust_.interfaces;
    const bool is_shared = straightens && distrust_.refinings == 0;
    if (is_shared) divided_ = shared_;
    if (!divided_) {
      const RegionDivision settings{straightens, distrust_.refinings, window_allowance()};
      divided_ = std::make_shared<const DividedRegion>(divide_region(region_, ground_, settings));
      budget_.spend(divided_->work);
    }
    if (is_shared) shared_ = divided_;
    mesh_ = divided_->mesh;
    has_no_chart_.assign(parts().size(), 0);
    for (Index p = 0; p < parts().size(); ++p) has_no_chart_[p] = is_distrusted(p);
  }

  const std::vector<std::vector<Index>>& parts() const { return divided_->division.parts; }
  const LaidOut& laid_out(std::size_t part) const { return *divided_->division.laid_out[part]; }

  bool is_distrusted(Index part) const {
    if (distrust_.all || is_turned_over(laid_out(part))) return true;
    return !distrust_.triangles.empty() && std::any_of(parts()[part].begin(), parts()[part].end(),
                                                       [&](Index f) { return distrust_.triangles[mesh_.near[f]]; });
  }

  void work_on_parts() {
    const std::size_t parts = this->parts().size();
    std::vector<Reworked> results(parts);
    std::vector<ConversionReport> reports(parts);
    std::vector<Record> records(parts);
    std::vector<char> is_stretched(parts, 0);
    const parallel::SharedProgress shared(options_.progress, double(mesh_.faces.size()));
    std::vector<ProgressCallback> progress;
    std::vector<Budget> budgets;
    const double most = work_in_charts();
    for (const auto& part : this->parts()) {
      progress.push_back(shared.part(double(part.size())));
      budgets.emplace_back(part_of(most, part.size(), mesh_.faces.size(), parts));
    }
    parallel::for_each_index(parts, [&](std::size_t p) {
      if (shared.is_over()) return;
      Options own = options_;
      own.progress = progress[p];
      const LaidOut& part = laid_out(p);
      try {
        if (has_no_chart_[p]) return;
        PartWork work = work_on_part(part, ground_, own, budgets[p], task_, reports[p], records[p], tries_);
        is_stretched[p] = work.is_stretched;
        results[p] = {&part.piece, std::move(work.mesh), {}};
        results[p].lifted = lift(results[p].mesh, part.piece, part.chart, background());
      } catch (const SurfaceError&) {
        has_no_chart_[p] = true;
      }
    });
    shared.finish();
    for (const Budget& own : budgets) budget_.spend(own.spent());
    for (std::size_t p = 0; p < parts; ++p) {
      if (!has_no_chart_[p]) continue;
      reports[p] = {};
      records[p] = {};
      if (wants_stages(options_)) records[p].stages.front() = laid_out(p).piece.mesh(laid_out(p).chart.flat());
    }
    for (std::size_t p = 0; p < parts; ++p) {
      work_.report.add(reports[p]);
      for (std::size_t i = 0; i < kStages; ++i) work_.seconds[i] += records[p].seconds[i];
      for (auto& front : records[p].fronts) work_.fronts.push_back(std::move(front));
    }
    for (std::size_t stage = 1; stage < work_.stages.size(); ++stage) work_.stages[stage] = at_stage(stage, records);
    std::erase_if(results, [](const Reworked& result) { return !result.piece; });
    note_stretched(is_stretched);
    mesh_ = replace(mesh_, results);
    if (results.size() < parts) pair_up_the_rest();
  }

  void note_stretched(const std::vector<char>& is_part_stretched) {
    if (!is_any(is_part_stretched)) return;
    stretched_.assign(region_.region.triangles.size(), 0);
    for (Index p = 0; p < is_part_stretched.size(); ++p)
      if (is_part_stretched[p] && !has_no_chart_[p])
        for (Index f : parts()[p]) stretched_[mesh_.near[f]] = 1;
  }

  void pair_up_the_rest() {
    needs_cleaning_.assign(mesh_.points.size(), 0);
    for (Index p = 0; p < has_no_chart_.size(); ++p)
      if (has_no_chart_[p])
        for (Index v : laid_out(p).piece.vertex) needs_cleaning_[v] = 1;
    budget_.spend(double(pair_up(mesh_, divided_->creases, background(), options_.smoothing)));
    needs_cleaning_.resize(mesh_.points.size(), 1);
  }

  /// The region as its parts were after a stage, or after the last one before it that was run.
  SurfaceMesh at_stage(std::size_t stage, const std::vector<Record>& records) const {
    std::vector<Reworked> parts;
    for (std::size_t p = 0; p < records.size(); ++p) {
      std::size_t last = stage;
      while (!records[p].stages[last]) --last;  // the input is always there
      const LaidOut& part = laid_out(p);
      parts.push_back({&part.piece, *records[p].stages[last], {}});
      parts.back().lifted = lift(parts.back().mesh, part.piece, part.chart, background());
    }
    return replace(mesh_, parts);
  }

  /// Interfaces were boundaries: irregular nodes beside them cancel now, and rows run straight on.
  void clean_interfaces() {
    if (divided_->interface.empty() && needs_cleaning_.empty()) return;
    std::vector<char> waiting = std::move(needs_cleaning_);
    waiting.resize(mesh_.points.size(), 0);
    for (const auto& [a, b] : divided_->interface) waiting[a] = waiting[b] = 1;
    work_in_windows(std::move(waiting), kCleaningWindow, clean_window, window_allowance());
  }

  /// True if it has changed the mesh. Windows cover all of it soon: where it is large, or has few irregular nodes, they
  /// cost more than they are worth.
  bool cancel_irregular_nodes() {
    constexpr int kPasses = 3;  // those that are gone make room for others to cancel
    constexpr std::size_t kLarge = 20'000;
    bool changed = false;
    for (int pass = 0; pass < kPasses && mesh_.faces.size() < kLarge; ++pass) {
      std::vector<char> irregular = irregular_nodes(mesh_, divided_->creases);
      const auto count = std::count(irregular.begin(), irregular.end(), 1);
      if (double(count) < kFewIrregular * double(mesh_.faces.size())) break;
      const double allowed = std::min(budget_.left(), window_allowance());
      if (!work_in_windows(std::move(irregular), kCancellingWindow, cancel_in_window, allowed)) break;
      changed = true;
    }
    return changed;
  }

  /// True if a window has changed.
  bool work_in_windows(std::vector<char> waiting, const WindowSize& size, Work work, double most) {
    const Ground ground{background(), stretched_.empty() ? nullptr : ground_.field};
    constexpr double kShares = 3;  // most windows need less than their share, some more
    bool changed = false;
    Budget budget(most);
    while (is_any(waiting)) {
      waiting.resize(mesh_.points.size(), 0);
      const std::vector<Window> windows =
          take_windows(mesh_, opposite_sides(mesh_), sides_on(mesh_, divided_->creases), size, waiting, budget);
      if (windows.empty()) break;
      std::size_t faces = 0;
      for (const Window& window : windows) faces += window.faces.size();
      const double allowed = std::max(0.0, budget.left());
      std::vector<WindowResult> reworked(windows.size());
      parallel::for_each_index(windows.size(), [&](std::size_t w) {
        const double share = kShares * part_of(allowed, windows[w].faces.size(), faces, windows.size());
        reworked[w] = work(*windows[w].laid_out, options_, ground, share);
      });
      std::vector<Reworked> results;
      for (WindowResult& window : reworked) {
        budget.spend(double(window.work));
        if (window.better) results.push_back(std::move(*window.better));
      }
      changed = changed || !results.empty();
      mesh_ = replace_where_simple(mesh_, std::move(results));
    }
    budget_.spend(budget.spent());
    return changed;
  }

  const CurvedRegion& region_;
  Options options_;
  Budget& budget_;
  const Task task_;
  const Distrust& distrust_;
  SharedDivision& shared_;
  const Tries tries_;
  const Ground ground_;
  RegionWork work_;
  SurfaceMesh mesh_;
  std::shared_ptr<const DividedRegion> divided_;
  std::vector<char> has_no_chart_;    ///< by part
  std::vector<char> needs_cleaning_;  ///< by node: of parts without a chart
  std::vector<char> stretched_;       ///< by triangle of the region; empty if none is
  space::Faults faults_;
};

/// Of what several tries have made, that with the fewest doubtful elements.
struct Best {
  std::optional<RegionWork> work;
  std::size_t doubtful = 0;

  void consider(Worker& worker) {
    if (work && worker.doubtful() >= doubtful) return;
    doubtful = worker.doubtful();
    work = worker.result();
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
  constexpr std::size_t kSmall = 5000;  // triangles, so that a doubtful element is worth another try
  constexpr std::size_t kFew = 50;      // so that it is worth all of them
  const std::size_t size = region.region.triangles.size();
  Distrust distrust;
  std::optional<SurfaceError> first;
  Best best;
  std::size_t fewest_turned = std::numeric_limits<std::size_t>::max();
  for (int i = 1; i <= kTries; ++i) {
    if (best.work && !has_more_for(budget, size)) break;
    distrust.all = distrust.all || i == kTries || !has_more_for(budget, size);
    Worker worker(region, options, budget, task, distrust, shared);
    if (worker.run()) {
      const bool is_new = worker.learn(distrust);
      best.consider(worker);
      if (best.doubtful == 0 || !is_new || size > kSmall) break;
    } else {
      if (!first) first = worker.find_fault();
      fewest_turned = std::min(fewest_turned, worker.turned());
      const std::size_t most_turned = size > kSmall ? kFewTurned : kManyTurned;
      if (distrust.all || (worker.turned() > most_turned && !has_more_for(budget, size))) break;
      if (!worker.learn(distrust)) distrust.all = true;
    }
    distrust.interfaces = true;
  }
  if (best.work && (best.doubtful == 0 || size > kFew)) return std::move(*best.work);
  // What is valid in a chart may have no valid place on a surface that turns sharply; what another front makes may have
  // one, if there are few such places.
  const bool is_hopeful = task == Task::convert && (best.work || fewest_turned <= kFewTurned);
  if (is_hopeful && size <= options.retry_triangles) {
    const Distrust nothing;
    for (const Options& variant : few_front_variants(options)) {
      if (!has_more_for(budget, size)) break;
      Worker worker(region, variant, budget, task, nothing, shared);
      if (!worker.run()) continue;
      best.consider(worker);
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
    if (Worker worker(region, options, budget, task, nodes, shared); worker.run()) best.consider(worker);
  if (best.work) return std::move(*best.work);
  throw *first;
}

std::optional<RegionWork> try_region(const CurvedRegion& region, const Options& options, Budget& budget, Task task,
                                     SharedDivision& shared) {
  const Distrust nothing;
  Worker worker(region, options, budget, task, nothing, shared, Tries::one);
  if (!worker.run() || worker.doubtful() > 0) return {};
  return worker.result();
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
