// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/convert_region.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "bands/lay_blade.hpp"
#include "bands/lay_chords.hpp"
#include "bands/lay_rows.hpp"
#include "cleanup/raise_worth.hpp"
#include "cleanup/refill.hpp"
#include "engine/ear.hpp"
#include "engine/fans.hpp"
#include "engine/front_variants.hpp"
#include "engine/fronts_made.hpp"
#include "engine/grid_pairs.hpp"
#include "engine/parts/convert_parts.hpp"
#include "engine/prepare.hpp"
#include "engine/worth.hpp"
#include "qmorph/error.hpp"
#include "smoothing/corner_energy.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph {
namespace {

/// What the stages have made of a region so far.
struct Attempt {
  kernel::Mesh mesh;
  Options options{};
  double allowed = 0;     ///< work
  double promise = 0;     ///< what the mesh was worth when it was clean: nearly all about what it will be
  bool is_quick = false;  ///< so that cleaning is not done
  ConversionReport report{};
  Record record{};
  std::optional<SurfaceError> fault{};
};

bool is_small(const Region& region, const Options& options) {
  return 2 * region.triangles.size() <= options.retry_triangles;
}

/// Whether so many triangles are few enough for other constants of the front.
bool may_try_again(std::size_t triangles, const Options& options) { return triangles <= 2 * options.retry_triangles; }

/// What an attempt costs however small the region is.
constexpr std::size_t kWorkPerAttempt = 200;
/// What the front and all that is not counted cost another attempt: for each triangle, and however few there are. (The
/// first is no improvement.)
constexpr std::size_t kWorkToAdvance = 250, kWorkToBegin = 500;
/// Of a triangle that is added where a fan is graded.
constexpr std::size_t kWorkToGrade = 100;
/// What tries may cost before the last of them, however small the region is and for each triangle; and for each
/// triangle if a corner is poor after these.
constexpr std::size_t kWorkForAnyTries = 20'000, kWorkForTries = 200, kWorkIfPoor = 2000;
/// What changes to the best of them may cost for each triangle, and of what is allowed at most.
constexpr std::size_t kWorkToClimb = 700;
constexpr double kShareToClimb = 0.105;
/// What a search for a better worst quad may cost, for each triangle and at most: a few milliseconds.
constexpr double kWorkToLift = 5000, kMostToLift = 400'000;
/// Irregular nodes that a cavity grows to in a try, until it is known to be the best.
constexpr int kQuickNodes = 1;

class RegionConverter {
 public:
  /// `budget`: for all attempts together.
  RegionConverter(const Region& region, const Plane& plane, const Options& options, Budget& budget, Tries tries)
      : region_(region),
        plane_(plane),
        options_(options),
        is_small_(is_small(region, options)),
        budget_(budget),
        tries_(tries) {
    start();
    to_climb_ = work_to_climb();
    allowed_ = budget.left() - to_climb_;
  }

  Attempt run() {
    std::optional<SurfaceError> fault = find_needles(start_, plane_);
    if (!fault) {
      if (auto grid = attempt_as_grid()) return std::move(*grid);
      if (auto parts = attempt_in_parts()) return std::move(*parts);
      const std::size_t size = count_faces(start_, 3);  // fans may have been refined
      constexpr std::size_t kFewest = 3;                // with fewer a front has no choice
      const bool has_tries = size >= kFewest && may_try_again(size, options_);
      Attempt result;
      if (has_tries) {
        result = best_of_tries(size);
        spend_rest(result);
        climb(result);
        refill(result);
      } else {
        result = begin(std::move(start_), options_, allowed_);
        if (result.fault) {
          Attempt paired = pair_triangles();
          take_chords(paired);
          if (!paired.fault) return paired;
          Pipeline(result.options, result.report, result.record, input_, left()).clean(result.mesh);
          result.fault.reset();
        }
        finish(result);
        take_rows(result);
        take_chords(result);
        take_pairs(result);
        refill(result);
      }
      if (!result.fault) return result;
      fault = result.fault;
    }
    // A front has no room in fans and needles. Pairing the triangles as they are often has.
    Attempt paired = pair_triangles();
    take_chords(paired);
    if (paired.fault) throw *fault;
    return paired;
  }

 private:
  /// Makes the mesh that the front begins with.
  void start() {
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

  /// In the chart of a curved surface the worst quad says less: in space it will be another.
  Worth judge(const kernel::Mesh& mesh) const {
    constexpr double kLittleInChart = 0.1;
    Worth worth = worth_of(mesh, region_.triangles.size());
    if (plane_.curved) worth.good_enough = Worth::kGoodEnoughInChart, worth.little = kLittleInChart;
    return worth;
  }

  /// A thin band as rows, if they are worth more. A short one, one with oblique ends, and rows that are finer than
  /// asked for are taken only in place of what solvers refuse: where the ends of a strip have nodes in their middles,
  /// say.
  void take_rows(Attempt& best) {
    constexpr double kAsGood = 0.01;
    // In a chart it cannot be seen what the triangle of an odd one does to the quads beside it in space.
    if (best.fault || (plane_.curved && region_.boundary_sides % 2 != 0)) return;
    std::optional<bands::Band> band = bands::find_band(region_);
    const bool is_usual = band.has_value();
    if (!band && judge(best.mesh).least < kRefused) band = bands::find_band(region_, bands::kAnyBand);
    if (!band) return;
    for (const bands::RowCosts& costs : {bands::kBetterTurns, bands::kFewerTurns}) {
      auto rows = bands::lay_rows(*band, region_.points, costs);
      if (!rows) return;
      const bool may_have_others = has_irregular_nodes(*rows);
      Attempt laid = begin(std::move(*rows), options_, left_for_rows(), Way::without_front);
      finish(laid);
      const Worth one = judge(laid.mesh), other = judge(best.mesh);
      // A poor quad more is too high a price for rows.
      const double least = is_usual ? std::min(other.least - kAsGood, kFair) : kFair;
      if (!laid.fault && is_worth_more(one, other) && one.least >= least) best = std::move(laid);
      if (!may_have_others) return;  // of rows that never turn, other costs make the same
    }
  }

  /// A poor region without room for nodes inside as the best quads between those of its boundary, or one that runs out
  /// in a sharp corner as rows from there, if they are worth more and the worst is no worse.
  void take_chords(Attempt& best) {
    constexpr double kPoor = 0.3;
    for (const auto lay : {bands::lay_chords, bands::lay_blade}) {
      const Worth worth = judge(best.mesh);
      if (best.fault || worth.least >= kPoor) return;
      auto laid_mesh = lay(region_);
      if (!laid_mesh) continue;
      Attempt laid = begin(std::move(*laid_mesh), options_, left(), Way::without_front);
      finish(laid);
      if (laid.fault || !is_better(judge(laid.mesh), worth)) continue;
      // Rows of a crescent are long and thin anyway; then right angles are what is left to gain.
      if (lay == bands::lay_blade && mean_sine(laid.mesh) < mean_sine(best.mesh)) continue;
      best = std::move(laid);
    }
  }

  static bool has_irregular_nodes(const kernel::Mesh& mesh) {
    const std::vector<Index> valences = mesh.valences();
    for (Index v = 0; v < valences.size(); ++v)
      if (mesh.is_live_vertex(v) && !mesh.is_boundary(v) && valences[v] != 4) return true;
    return false;
  }

  Attempt pair_triangles() {
    if (start_.face_slots() == 0) start();  // the front has taken it
    Attempt paired = begin(start_, options_, left(), Way::without_front);
    finish(paired);
    return paired;
  }

  /// Where the front has gone astray (its quads are far too many then, be they good or poor), or a small region of a
  /// plane leaves it no room, triangles may be worth more paired as they are. (What has long quads in a chart often has
  /// no valid place in space.)
  void take_pairs(Attempt& best) {
    constexpr double kPoor = 0.3, kAsGood = 0.05;
    const Worth worth = judge(best.mesh);
    const bool is_astray = worth.growth > 2 * kFairGrowth * graded_;
    const bool has_no_room = is_small_ && !plane_.curved && worth.least < kPoor;
    if (best.fault || !(is_astray || has_no_room)) return;
    Attempt paired = pair_triangles();
    const Worth other = judge(paired.mesh);
    const bool has_fewer_poor = has_no_room && other.least >= worth.least - kAsGood && other.sum() > worth.sum() &&
                                count_poor(paired.mesh, kPoor) < count_poor(best.mesh, kPoor);
    if (!paired.fault && (has_fewer_poor || (is_astray && is_better(other, worth)))) best = std::move(paired);
  }

  /// What the first attempt may cost. Where others can follow, everything would be spent on the repair of a poor front;
  /// but what is not even repaired is worth less than another try.
  double work_for_first(std::size_t size) const {
    constexpr double kToRepair = 600, kLeast = 0.35, kMost = 0.7;
    if (!is_small_ || tries_ == Tries::one || plane_.curved) return allowed_;
    return std::clamp(kToRepair * double(size), kLeast * allowed_, kMost * allowed_);
  }

  /// The first attempt, or the most promising of those with other constants of the front. `size`: triangles that the
  /// front begins with.
  Attempt best_of_tries(std::size_t size) {
    // Under the first it is the boundary that is poor, and no try changes that.
    constexpr double kHopeless = 0.1, kPoor = 0.4;
    constexpr int kMostIfPoor = 2;
    Attempt best = begin(start_, options_, work_for_first(size), Way::one_of_many);
    finish(best);
    take_rows(best);
    take_chords(best);
    take_pairs(best);
    Worth worth = judge(best.mesh);
    const bool is_hopeless = worth.least < kHopeless && best.report.budgets_spent == 0;
    if (tries_ == Tries::one || best.fault || is_hopeless || is_good(worth)) return best;
    std::vector<Attempt> tries;
    const auto finish_most_promising = [&] {
      const auto promising = std::max_element(tries.begin(), tries.end(),
                                              [](const Attempt& a, const Attempt& b) { return a.promise < b.promise; });
      finish(*promising);
      const Worth other = judge(promising->mesh);
      if (!promising->fault && is_worth_more(other, worth)) best = std::move(*promising), worth = other;
      tries.erase(promising);
    };
    add_tries(tries, best, size, worth, true);
    if (!tries.empty()) finish_most_promising();
    if (worth.least >= kPoor) return best;
    add_tries(tries, best, size, worth, false);
    for (int i = 0; i < kMostIfPoor && !tries.empty() && worth.least < kPoor; ++i) finish_most_promising();
    return best;
  }

  /// Goes on where the share that an attempt had was not enough.
  void spend_rest(Attempt& best) {
    if (best.fault || !is_small_ || plane_.curved || tries_ == Tries::one || best.report.budgets_spent == 0 ||
        left() <= 0)
      return;
    Attempt more{best.mesh, best.options, double(best.mesh.work()) + left()};
    more.is_quick = true;  // cleaning is not done
    finish(more);
    if (more.fault || judge(more.mesh).sum() <= judge(best.mesh).sum()) return;
    best.mesh = std::move(more.mesh);
    best.report.budgets_spent = more.report.budgets_spent;
    for (std::size_t i = 0; i < more.record.stages.size(); ++i)
      if (more.record.stages[i]) best.record.stages[i] = std::move(more.record.stages[i]);
  }

  double work_to_climb() const {
    const bool may_climb = is_small_ && !plane_.curved && options_.smoothing.method == SmoothingMethod::shape_energy;
    const auto most = double(kWorkToClimb * region_.triangles.size());
    return may_climb ? std::min(kShareToClimb * budget_.left(), most) : 0;
  }

  void spend(std::size_t work) {
    cost_ += work;
    budget_.spend(double(work));
  }
  /// Of what is allowed for all but climb().
  double left() const { return budget_.left() - to_climb_; }

  /// However much the front has cost: rows come from a plan, and what a band is without them is hardly ever good.
  double left_for_rows() const {
    constexpr double kLeast = 0.15;
    return std::max(left(), kLeast * allowed_);
  }

  /// Changes one by one what a small region has become in the end.
  void climb(Attempt& best) {
    if (best.fault || to_climb_ <= 0) return;
    const std::size_t spent = best.mesh.work();
    kernel::Mesh mesh = best.mesh;
    const std::size_t changes =
        cleanup::raise_worth(mesh, options_.smoothing, {mesh, std::size_t(to_climb_)}) + lift_worst(mesh);
    spend(mesh.work() - spent);
    if (changes == 0) return;
    raise_corners(mesh, options_.smoothing);
    const Worth before = judge(best.mesh), after = judge(mesh);
    if (after.sum() <= before.sum() || after.least < std::min(before.least, Worth::kGoodEnough)) return;
    if (find_fault(mesh, region_, plane_)) return;
    best.mesh = std::move(mesh);
    if (wants_stages(best.options)) best.record.stages[std::size_t(Stage::repair)] = best.mesh;
  }

  /// In the end, whichever attempt it was: what is around poor quads by an exact search.
  void refill(Attempt& best) {
    if (best.fault || plane_.curved || !cleanup::has_poor_quads(best.mesh)) return;
    kernel::Mesh mesh = best.mesh;
    const std::size_t spent = mesh.work();
    const std::size_t changes =
        cleanup::refill_around_poor(mesh, options_.smoothing, {mesh, std::size_t(std::max(0.0, budget_.left()))});
    spend(mesh.work() - spent);
    if (changes == 0) return;
    if (is_small_) raise_corners(mesh, options_.smoothing);
    if (judge(mesh).least < judge(best.mesh).least || find_fault(mesh, region_, plane_)) return;
    best.mesh = std::move(mesh);
    if (wants_stages(best.options)) best.record.stages[std::size_t(Stage::repair)] = best.mesh;
  }

  /// A search around the worst quad, where that may help. Returns the number of changes.
  std::size_t lift_worst(kernel::Mesh& mesh) const {
    constexpr double kBoundaryIsPoor = 0.3;  // under that it nearly always is, and nothing was found
    constexpr std::size_t kFew = 150;        // triangles: in larger regions it costs much and brings little
    const double allowed = std::min({kWorkToLift * double(region_.triangles.size()), kMostToLift, left()});
    if (allowed <= 0 || region_.triangles.size() > kFew || judge(mesh).least < kBoundaryIsPoor) return 0;
    const std::size_t changes = cleanup::lift_worst(mesh, options_.smoothing, {mesh, std::size_t(allowed)});
    if (changes > 0) smoothing::smooth(mesh, options_.smoothing);
    return changes;
  }

  bool is_good(const Worth& worth) const {
    constexpr double kGood = 2.16, kGoodInChart = 2.05;
    return !worth.is_poor() && (!is_small_ || worth.sum() > (plane_.curved ? kGoodInChart : kGood));
  }

  /// Adds what other constants of the front make, after those that were tried before, as far as the work goes. `best`
  /// has `worth`; quick ones are fewer.
  void add_tries(std::vector<Attempt>& tries, Attempt& best, std::size_t size, const Worth& worth, bool is_quick) {
    constexpr std::size_t kMostGrowth = 2, kFew = 20;  // a front that makes many more faces than that has gone astray
    // A poor quad is worth some tries in a region that is not so small, too.
    constexpr std::size_t kTries = 6;
    const std::size_t most_triangles = std::max(options_.retry_triangles, worth.is_poor() ? kTries * size : 0);
    const std::size_t most_faces = kMostGrowth * (count_faces(best.mesh, 4) + kFew);
    const std::vector<Options> variants = front_variants(options_);
    const std::size_t before = cost_,
                      most_work = is_quick ? kWorkForAnyTries + kWorkForTries * size : kWorkIfPoor * size;
    for (; next_variant_ < variants.size(); ++next_variant_) {
      const Options& options = variants[next_variant_];
      if ((next_variant_ + 2) * size > most_triangles || cost_ - before > most_work) break;
      if (double(best.mesh.work()) > left()) {
        ++best.report.budgets_spent;
        break;
      }
      if (fronts_.would_repeat(options.front)) continue;
      budget_.spend(double(kWorkToBegin + kWorkToAdvance * size));
      Attempt other = begin(start_, options, left(), Way::one_of_many, is_quick);
      if (!other.fault && count_faces(other.mesh, 4) <= most_faces) tries.push_back(std::move(other));
    }
  }

  /// How a mesh of quads comes about.
  enum class Way { with_front, one_of_many, without_front };

  /// Up to where the mesh is clean.
  Attempt begin(kernel::Mesh mesh, const Options& options, double allowed, Way way = Way::with_front,
                bool is_quick = false) {
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

  void finish(Attempt& result) {
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

  /// Where the triangles are a grid's, their cells; moved only if that makes the worst much better. Nothing if a cell
  /// is poor, or there is no grid.
  std::optional<Attempt> attempt_as_grid() {
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

  /// Quads that there are without a front take its place among the stages.
  void note_cells(Attempt& attempt) const {
    if (!wants_stages(options_)) return;
    attempt.record.stages[std::size_t(Stage::input)] = input_;
    attempt.record.stages[std::size_t(Stage::front)] = attempt.mesh;
  }

  /// Nothing if the region is not large, or has no valid result in parts.
  std::optional<Attempt> attempt_in_parts() {
    if (!is_large(region_.triangles.size(), options_)) return {};
    Attempt result;
    auto mesh = convert_in_parts(std::move(start_), input_, plane_, options_, allowed_, result.report, result.record);
    if (mesh) {
      spend(mesh->work());
      result.mesh = std::move(*mesh);
      if (!find_fault(result.mesh, region_, plane_)) return result;
    }
    start();
    return {};
  }

  /// Raises the corners that are not good enough, or as many as asked for if the others do not lose more by it; again
  /// where quads are still poor, since each time only a share of all elements counts as bad.
  void raise_corners(kernel::Mesh& mesh, const SmoothingOptions& smoothing) const {
    constexpr int kMostTimes = 3;
    if (smoothing.method != SmoothingMethod::shape_energy) return;
    for (int time = 0; time < kMostTimes; ++time)
      if (!raise_corners_once(mesh, smoothing) || !cleanup::has_poor_quads(mesh)) return;
  }

  /// Whether the mesh is worth more for it; if not, it stays.
  bool raise_corners_once(kernel::Mesh& mesh, const SmoothingOptions& smoothing) const {
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

  const Region& region_;
  const Plane& plane_;
  const Options& options_;
  const bool is_small_;  ///< so that a second try is allowed
  Budget& budget_;
  double graded_ = 1;    ///< triangles of `start_` for each of the region's
  double to_climb_ = 0;  ///< work that is kept for climb()
  double allowed_ = 0;   ///< for all the rest
  const Tries tries_;
  std::size_t cost_ = 0;  ///< of all attempts so far
  FrontsMade fronts_;
  std::size_t next_variant_ = 0;  ///< of front_variants()
  kernel::Mesh start_;            ///< what the front begins with
  kernel::Mesh input_;            ///< as it came, if stages are measured
};

/// The same with an ear set aside: the one triangle that an odd boundary leaves.
std::optional<Attempt> convert_without_ear(const Region& region, const Plane& plane, const Options& options,
                                           Budget& budget, Tries tries) {
  if (region.boundary_sides % 2 == 0 || !is_small(region, options) || budget.is_spent()) return {};
  const std::optional<Ear> ear = sharpest_ear(region);
  if (!ear) return {};
  try {
    const Region rest = cut_off(region, *ear);
    budget.spend(double(kWorkToBegin + kWorkToAdvance * rest.triangles.size()));
    Attempt result = RegionConverter(rest, plane, options, budget, tries).run();
    put_back(result.mesh, *ear);
    ++result.report.leftover_triangles;  // the front leaves the ear, too
    for (auto& stage : result.record.stages)
      if (stage) put_back(*stage, *ear);
    return result;
  } catch (const SurfaceError&) {
    return {};
  }
}

}  // namespace

kernel::Mesh convert_region(const Region& region, const Plane& plane, const Options& options, Budget& budget,
                            ConversionReport& report, Record& record, Tries tries) {
  const std::size_t size = region.triangles.size();
  Attempt best = RegionConverter(region, plane, options, budget, tries).run();
  if (auto other = convert_without_ear(region, plane, options, budget, tries))
    if (is_worth_more(worth_of(other->mesh, size), worth_of(best.mesh, size))) best = std::move(*other);
  report = best.report;
  record = std::move(best.record);
  return std::move(best.mesh);
}

}  // namespace qmorph
