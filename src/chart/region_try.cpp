// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/region_try.hpp"

#include <algorithm>
#include <utility>

#include "chart/irregular_nodes.hpp"
#include "chart/pair_up.hpp"
#include "chart/refine.hpp"
#include "chart/topology.hpp"
#include "chart/widen_tips.hpp"
#include "geometry/describe.hpp"
#include "kernel/is_any.hpp"
#include "parallel/for_each.hpp"
#include "parallel/shared_progress.hpp"

namespace qmorph::chart {
namespace {

constexpr WindowSize kCleaningWindow{8, 5, 800, true};
constexpr WindowSize kCancellingWindow{14, 9, 1500, true};

}  // namespace

RegionTry::RegionTry(const CurvedRegion& region, const Options& options, Budget& budget, Task task,
                     const Distrust& distrust, SharedDivision& shared, Tries tries)
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

bool RegionTry::run() {
  if (wants_stages(options_)) work_.stages.assign(kStages - 1, started());
  divide();
  work_on_parts();
  if (is_hopeless()) return false;
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

RegionWork RegionTry::result() {
  work_.mesh = std::move(mesh_);
  return std::move(work_);
}

std::optional<SurfaceError> RegionTry::find_fault() const {
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

bool RegionTry::learn(Distrust& distrust) const {
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

SurfaceMesh RegionTry::started() const {
  SurfaceMesh mesh = region_.start();
  for (int i = 0; i < distrust_.refinings; ++i) mesh = refined(mesh, region_.creases);
  return mesh;
}

double RegionTry::window_allowance() const {
  constexpr double kTimes = 8, kEach = 1800;
  const std::size_t size = region_.region.triangles.size();
  return kTimes * (allowance(size) + kEach * double(size));
}

double RegionTry::work_in_charts() const {
  constexpr double kShare = 0.5, kLeastEach = 500;
  const std::size_t size = region_.region.triangles.size();
  return std::min(allowance(size), std::max(kShare * budget_.left(), kLeastEach * double(size)));
}

bool RegionTry::is_hopeless() {
  constexpr double kSmoothShare = 0.9;  // of the triangles
  const std::size_t size = region_.region.triangles.size();
  if (task_ != Task::convert || size <= kSmallRegion) return false;
  std::size_t smooth = 0;
  for (Index t = 0; t < size; ++t) smooth += background().is_smooth(t);
  if (double(smooth) > kSmoothShare * double(size)) return false;
  std::vector<Index> turned = space::find_turned(mesh_, divided_->creases, region_, stretched_);
  const bool is_worse = turned.size() > std::max(kFewTurned, distrust_.fewest_turned);
  if (!is_worse && !are_hopeless(turned.size(), size)) return false;
  faults_.turned = std::move(turned);
  return true;
}

bool RegionTry::improve() {
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

bool RegionTry::improve_as_it_is() {
  faults_ = space::improve(mesh_, divided_->creases, region_, stretched_, options_.smoothing);
  budget_.spend(double(faults_.work));
  return !find_fault();
}

void RegionTry::divide() {
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

bool RegionTry::is_distrusted(Index part) const {
  if (distrust_.all || is_turned_over(laid_out(part))) return true;
  return !distrust_.triangles.empty() && std::any_of(parts()[part].begin(), parts()[part].end(),
                                                     [&](Index f) { return distrust_.triangles[mesh_.near[f]]; });
}

void RegionTry::work_on_parts() {
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

void RegionTry::note_stretched(const std::vector<char>& is_part_stretched) {
  if (!is_any(is_part_stretched)) return;
  stretched_.assign(region_.region.triangles.size(), 0);
  for (Index p = 0; p < is_part_stretched.size(); ++p)
    if (is_part_stretched[p] && !has_no_chart_[p])
      for (Index f : parts()[p]) stretched_[mesh_.near[f]] = 1;
}

void RegionTry::pair_up_the_rest() {
  needs_cleaning_.assign(mesh_.points.size(), 0);
  for (Index p = 0; p < has_no_chart_.size(); ++p)
    if (has_no_chart_[p])
      for (Index v : laid_out(p).piece.vertex) needs_cleaning_[v] = 1;
  budget_.spend(double(pair_up(mesh_, divided_->creases, background(), options_.smoothing)));
  needs_cleaning_.resize(mesh_.points.size(), 1);
}

SurfaceMesh RegionTry::at_stage(std::size_t stage, const std::vector<Record>& records) const {
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

void RegionTry::clean_interfaces() {
  if (divided_->interface.empty() && needs_cleaning_.empty()) return;
  std::vector<char> waiting = std::move(needs_cleaning_);
  waiting.resize(mesh_.points.size(), 0);
  for (const auto& [a, b] : divided_->interface) waiting[a] = waiting[b] = 1;
  work_in_windows(std::move(waiting), kCleaningWindow, clean_window, window_allowance());
}

bool RegionTry::cancel_irregular_nodes() {
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

bool RegionTry::work_in_windows(std::vector<char> waiting, const WindowSize& size, WindowWork work, double most) {
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

}  // namespace qmorph::chart
