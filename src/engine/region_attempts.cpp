// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/region_attempts.hpp"

#include <algorithm>
#include <utility>

#include "cleanup/refill.hpp"
#include "engine/fans.hpp"
#include "engine/grid_pairs.hpp"
#include "engine/parts/convert_parts.hpp"
#include "engine/prepare.hpp"
#include "smoothing/corner_energy.hpp"
#include "topology/edits.hpp"

namespace qmorph {
namespace {

/// What an attempt costs however small the region is.
constexpr std::size_t kWorkPerAttempt = 200;
/// Of a triangle that is added where a fan is graded, with what the front costs there.
constexpr std::size_t kWorkToGrade = 210;
/// Irregular nodes that a cavity grows to in a try, until it is known to be the best.
constexpr int kQuickNodes = 1;

}  // namespace

RegionAttempts::RegionAttempts(const Region& region, const Plane& plane, const Options& options, Budget& budget)
    : region_(region), plane_(plane), options_(options), is_small_(qmorph::is_small(region, options)), budget_(budget) {
  prepare();
  allowed_ = budget.left();
}

void RegionAttempts::keep_back(double work) {
  kept_back_ = work;
  allowed_ = left();
}

void RegionAttempts::prepare() {
  start_ = kernel::Mesh(region_.points, region_.triangles, region_.open);
  for (Index v : region_.fixed) start_.set_fixed(v);
  if (wants_stages(options_)) input_ = start_;
  repair_input(start_, region_.node, plane_);
  grade_fans(start_);
  // What makes fans better is no reason to spend more on the region.
  const std::size_t size = count_faces(start_, 3), before = region_.triangles.size();
  if (size > before) budget_.spend(double(kWorkToGrade * (size - before)));
  graded_ = double(size) / double(before);
}

Worth RegionAttempts::judge(const kernel::Mesh& mesh) const {
  constexpr double kLittleInChart = 0.1;
  Worth worth = worth_of(mesh, region_.triangles.size());
  if (plane_.curved) worth.good_enough = Worth::kGoodEnoughInChart, worth.little = kLittleInChart;
  return worth;
}

void RegionAttempts::spend(std::size_t work) {
  cost_ += work;
  budget_.spend(double(work));
}

double RegionAttempts::left_for_rows() const {
  constexpr double kLeast = 0.15;
  return std::max(left(), kLeast * allowed_);
}

Attempt RegionAttempts::begin(kernel::Mesh mesh, const Options& options, double allowed, Way way, bool is_quick) {
  Attempt result{std::move(mesh), options, allowed};
  result.is_quick = is_quick;
  result.mesh.add_work(kWorkPerAttempt);
  if (is_small_) result.options.smoothing.good_quality = 0;  // raise_corners() tries what pays
  Pipeline pipeline(result.options, result.report, result.record, input_, allowed);
  front::Decisions decisions{};
  const bool is_astray = way != Way::without_front &&
                         !pipeline.advance_front(result.mesh, plane_, way == Way::one_of_many ? &decisions : nullptr);
  cleanup::CavityLimits limits;
  if (is_quick) limits.most_nodes = kQuickNodes;
  if (way == Way::one_of_many && fronts_.is_repeated(decisions, result.mesh))
    result.fault = SurfaceError("the front has made this before");
  else if (way == Way::with_front && is_astray)
    result.fault = SurfaceError("the front has gone astray");
  else
    pipeline.clean(result.mesh, limits);
  spend(result.mesh.work());
  if (way == Way::one_of_many && !result.fault) result.promise = judge(result.mesh).sum();
  return result;
}

void RegionAttempts::clean_astray(Attempt& attempt) {
  Pipeline(attempt.options, attempt.report, attempt.record, input_, left()).clean(attempt.mesh);
  attempt.fault.reset();
}

void RegionAttempts::finish(Attempt& result) {
  const std::size_t before = result.mesh.work();
  Pipeline pipeline(result.options, result.report, result.record, input_, result.allowed);
  if (result.is_quick) pipeline.clean_further(result.mesh);
  pipeline.polish(result.mesh);
  if (!plane_.curved) pipeline.open_tips(result.mesh);
  spend(result.mesh.work() - before);
  if (is_small_) raise_corners(result.mesh, options_.smoothing);
  if (is_small_ && wants_stages(result.options)) result.record.stages[std::size_t(Stage::repair)] = result.mesh;
  result.fault = find_fault(result.mesh, region_, plane_);
}

Attempt RegionAttempts::pair_triangles() {
  if (start_.face_slots() == 0) prepare();  // the front has taken it
  Attempt paired = begin(start_, options_, left(), Way::without_front);
  finish(paired);
  return paired;
}

std::optional<Attempt> RegionAttempts::attempt_as_grid() {
  constexpr double kMuch = 0.01;  // worth moving for
  auto cells = options_.layers ? pair_as_grid(start_) : std::nullopt;
  if (!cells) return {};
  const Worth before = judge(*cells);
  Attempt result{std::move(*cells), options_, allowed_};
  Attempt moved{result.mesh, options_, allowed_};
  for (Attempt* attempt : {&result, &moved}) note_cells(*attempt);
  Pipeline pipeline(moved.options, moved.report, moved.record, input_, allowed_);
  pipeline.polish(moved.mesh);
  const Worth after = judge(moved.mesh);
  spend(moved.mesh.work());
  if (after.least > before.least + kMuch) result = std::move(moved);
  result.fault = find_fault(result.mesh, region_, plane_);
  if (result.fault || std::max(before.least, after.least) < kPoorestCell) return {};
  return result;
}

void RegionAttempts::note_cells(Attempt& attempt) const {
  if (!wants_stages(options_)) return;
  attempt.record.stages[std::size_t(Stage::input)] = input_;
  attempt.record.stages[std::size_t(Stage::front)] = attempt.mesh;
}

std::optional<Attempt> RegionAttempts::attempt_in_parts() {
  if (!is_large(region_.triangles.size(), options_)) return {};
  Attempt result;
  auto mesh = convert_in_parts(std::move(start_), input_, plane_, options_, allowed_, result.report, result.record);
  if (mesh) {
    spend(mesh->work());
    result.mesh = std::move(*mesh);
    if (!find_fault(result.mesh, region_, plane_)) return result;
  }
  prepare();
  return {};
}

void RegionAttempts::raise_corners(kernel::Mesh& mesh, const SmoothingOptions& smoothing) const {
  constexpr int kMostTimes = 3;
  if (smoothing.method != SmoothingMethod::shape_energy) return;
  for (int time = 0; time < kMostTimes; ++time)
    if (!raise_corners_once(mesh, smoothing) || !cleanup::has_poor_quads(mesh)) return;
}

bool RegionAttempts::raise_corners_once(kernel::Mesh& mesh, const SmoothingOptions& smoothing) const {
  const kernel::Mesh start = mesh;
  bool is_raised = false;
  for (double good : {judge(mesh).good_enough, smoothing.good_quality}) {
    SmoothingOptions options = smoothing;
    options.good_quality = std::min(good, smoothing.good_quality);
    kernel::Mesh raised = start;
    smoothing::raise_worst_corners(raised, options);
    if (judge(raised).sum() <= judge(mesh).sum()) continue;
    mesh = std::move(raised);
    is_raised = true;
  }
  return is_raised;
}

}  // namespace qmorph
