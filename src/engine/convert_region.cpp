// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/convert_region.hpp"

#include <algorithm>
#include <utility>

#include "bands/lay_blade.hpp"
#include "bands/lay_chords.hpp"
#include "bands/lay_gaps.hpp"
#include "bands/lay_rows.hpp"
#include "bands/relay_rows.hpp"
#include "cleanup/raise_worth.hpp"
#include "cleanup/refill.hpp"
#include "engine/ear.hpp"
#include "engine/front_variants.hpp"
#include "engine/prepare.hpp"
#include "engine/region_attempts.hpp"
#include "engine/worth.hpp"
#include "qmorph/error.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph {
namespace {

/// Whether so many triangles are few enough for other constants of the front.
bool may_try_again(std::size_t triangles, const Options& options) { return triangles <= 2 * options.retry_triangles; }

/// What the front and all that is not counted cost another attempt: for each triangle, and however few there are. (The
/// first is no improvement.)
constexpr std::size_t kWorkToAdvance = 250, kWorkToBegin = 500;
/// What tries may cost before the last of them, however small the region is and for each triangle; and for each
/// triangle if a corner is poor after these.
constexpr std::size_t kWorkForAnyTries = 20'000, kWorkForTries = 200, kWorkIfPoor = 2000;
/// What changes to the best of them may cost for each triangle, and of what is allowed at most.
constexpr std::size_t kWorkToClimb = 700;
constexpr double kShareToClimb = 0.105;
/// What a search for a better worst quad may cost, for each triangle and at most: a few milliseconds.
constexpr double kWorkToLift = 5000, kMostToLift = 400'000;

class RegionConverter {
 public:
  /// `budget`: for all attempts together.
  RegionConverter(const Region& region, const Plane& plane, const Options& options, Budget& budget, Tries tries)
      : region_(region),
        plane_(plane),
        options_(options),
        budget_(budget),
        tries_(tries),
        attempts_(region, plane, options, budget),
        to_climb_(work_to_climb()) {
    attempts_.keep_back(to_climb_);
  }

  Attempt run() {
    std::optional<SurfaceError> fault = find_needles(attempts_.start(), plane_);
    if (!fault) {
      if (auto grid = attempts_.attempt_as_grid()) return std::move(*grid);
      if (auto parts = attempts_.attempt_in_parts()) return std::move(*parts);
      const std::size_t size = count_faces(attempts_.start(), 3);  // fans may have been refined
      constexpr std::size_t kFewest = 3;                           // with fewer a front has no choice
      const bool has_tries = size >= kFewest && may_try_again(size, options_);
      Attempt result = has_tries ? with_tries(size) : with_one_front();
      if (!result.fault) return result;
      fault = result.fault;
    }
    // A front has no room in fans and needles. Pairing the triangles as they are often has.
    Attempt paired = attempts_.pair_triangles();
    take_chords(paired);
    if (paired.fault) throw *fault;
    refill(paired);
    return paired;
  }

 private:
  Attempt with_tries(std::size_t size) {
    Attempt result = best_of_tries(size);
    spend_rest(result);
    climb(result);
    refill(result);
    return result;
  }

  Attempt with_one_front() {
    Attempt result = attempts_.begin(attempts_.take_start(), options_, attempts_.allowed());
    if (result.fault) {
      Attempt paired = attempts_.pair_triangles();
      take_chords(paired);
      refill(paired);
      if (!paired.fault) return paired;
      attempts_.clean_astray(result);
    }
    attempts_.finish(result);
    take_rows(result);
    take_gaps(result);
    take_chords(result);
    take_pairs(result);
    refill(result);
    return result;
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
    if (!band && attempts_.judge(best.mesh).least < kRefused) band = bands::find_band(region_, bands::kAnyBand);
    if (!band) return;
    for (const bands::RowCosts& costs : {bands::kBetterTurns, bands::kFewerTurns}) {
      auto rows = bands::lay_rows(*band, region_.points, costs);
      if (!rows) return;
      const bool may_have_others = has_irregular_nodes(*rows);
      Attempt laid = attempts_.begin(std::move(*rows), options_, attempts_.left_for_rows(), Way::without_front);
      attempts_.finish(laid);
      const Worth one = attempts_.judge(laid.mesh), other = attempts_.judge(best.mesh);
      // A poor quad more is too high a price for rows.
      const double least = is_usual ? std::min(other.least - kAsGood, kFair) : kFair;
      if (!laid.fault && is_worth_more(one, other) && one.least >= least) best = std::move(laid);
      if (!may_have_others) return;  // of rows that never turn, other costs make the same
    }
  }

  /// A net of gaps as rows along them, if they are worth more or far fewer are poor, and the worst is no worse.
  bool take_gaps(Attempt& best) {
    if (best.fault || plane_.curved || attempts_.judge(best.mesh).least >= kFair) return false;
    auto mesh = bands::lay_gaps(region_);
    if (!mesh) return false;
    Attempt laid = attempts_.begin(std::move(*mesh), options_, attempts_.left_for_rows(), Way::without_front);
    attempts_.finish(laid);
    const Worth one = attempts_.judge(laid.mesh), other = attempts_.judge(best.mesh);
    const bool has_fewer_poor = 2 * count_poor(laid.mesh, kRefused) < count_poor(best.mesh, kRefused);
    if (laid.fault || one.least < other.least || !(has_fewer_poor || is_worth_more(one, other))) return false;
    best = std::move(laid);
    return true;
  }

  /// A poor region without room for nodes inside as the best quads between those of its boundary, or one that runs out
  /// in a sharp corner as rows from there, if they are worth more and the worst is no worse.
  void take_chords(Attempt& best) {
    constexpr double kPoor = 0.3;
    Worth worth = attempts_.judge(best.mesh);
    for (const auto lay : {bands::lay_chords, bands::lay_blade}) {
      if (best.fault || worth.least >= kPoor) return;
      auto laid_mesh = lay(region_);
      if (!laid_mesh) continue;
      Attempt laid = attempts_.begin(std::move(*laid_mesh), options_, attempts_.left(), Way::without_front);
      attempts_.finish(laid);
      const Worth other = attempts_.judge(laid.mesh);
      if (laid.fault || !is_better(other, worth)) continue;
      // Rows of a crescent are long and thin anyway; then right angles are what is left to gain.
      if (lay == bands::lay_blade && mean_sine(laid.mesh) < mean_sine(best.mesh)) continue;
      best = std::move(laid), worth = other;
    }
  }

  /// Where the front has gone astray (its quads are far too many then, be they good or poor), or a small region of a
  /// plane leaves it no room, triangles may be worth more paired as they are. (What has long quads in a chart often has
  /// no valid place in space.)
  void take_pairs(Attempt& best) {
    constexpr double kPoor = 0.3, kAsGood = 0.05;
    const Worth worth = attempts_.judge(best.mesh);
    const bool is_astray = worth.growth > 2 * kFairGrowth * attempts_.growth_at_start();
    const bool has_no_room = attempts_.is_small() && !plane_.curved && worth.least < kPoor;
    if (best.fault || !(is_astray || has_no_room)) return;
    Attempt paired = attempts_.pair_triangles();
    const Worth other = attempts_.judge(paired.mesh);
    const bool has_fewer_poor = has_no_room && other.least >= worth.least - kAsGood && other.sum() > worth.sum() &&
                                count_poor(paired.mesh, kPoor) < count_poor(best.mesh, kPoor);
    if (!paired.fault && (has_fewer_poor || (is_astray && is_better(other, worth)))) best = std::move(paired);
  }

  /// What the first attempt may cost. Where others can follow, everything would be spent on the repair of a poor front;
  /// but what is not even repaired is worth less than another try.
  double work_for_first(std::size_t size) const {
    constexpr double kToRepair = 600, kLeast = 0.35, kMost = 0.7;
    if (!attempts_.is_small() || tries_ == Tries::one || plane_.curved) return attempts_.allowed();
    return std::clamp(kToRepair * double(size), kLeast * attempts_.allowed(), kMost * attempts_.allowed());
  }

  /// The first attempt, or the most promising of those with other constants of the front. `size`: triangles that the
  /// front begins with.
  Attempt best_of_tries(std::size_t size) {
    // Under the first it is the boundary that is poor, and no try changes that.
    constexpr double kHopeless = 0.1, kPoor = 0.4;
    constexpr int kMostIfPoor = 2;
    Attempt best = attempts_.begin(attempts_.start(), options_, work_for_first(size), Way::one_of_many);
    attempts_.finish(best);
    take_rows(best);
    if (take_gaps(best)) return best;
    take_chords(best);
    take_pairs(best);
    Worth worth = attempts_.judge(best.mesh);
    const bool is_hopeless = worth.least < kHopeless && best.report.budgets_spent == 0;
    if (tries_ == Tries::one || best.fault || is_hopeless || is_good(worth)) return best;
    std::vector<Attempt> tries;
    const auto finish_most_promising = [&] {
      const auto promising = std::max_element(tries.begin(), tries.end(),
                                              [](const Attempt& a, const Attempt& b) { return a.promise < b.promise; });
      attempts_.finish(*promising);
      const Worth other = attempts_.judge(promising->mesh);
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
    if (best.fault || !attempts_.is_small() || plane_.curved || tries_ == Tries::one ||
        best.report.budgets_spent == 0 || attempts_.left() <= 0)
      return;
    Attempt more{best.mesh, best.options, double(best.mesh.work()) + attempts_.left()};
    more.is_quick = true;  // cleaning is not done
    attempts_.finish(more);
    if (more.fault || attempts_.judge(more.mesh).sum() <= attempts_.judge(best.mesh).sum()) return;
    best.mesh = std::move(more.mesh);
    best.report.budgets_spent = more.report.budgets_spent;
    for (std::size_t i = 0; i < more.record.stages.size(); ++i)
      if (more.record.stages[i]) best.record.stages[i] = std::move(more.record.stages[i]);
  }

  double work_to_climb() const {
    const bool may_climb =
        attempts_.is_small() && !plane_.curved && options_.smoothing.method == SmoothingMethod::shape_energy;
    const auto most = double(kWorkToClimb * region_.triangles.size());
    return may_climb ? std::min(kShareToClimb * budget_.left(), most) : 0;
  }

  /// Changes one by one what a small region has become in the end.
  void climb(Attempt& best) {
    if (best.fault || to_climb_ <= 0) return;
    const std::size_t spent = best.mesh.work();
    kernel::Mesh mesh = best.mesh;
    const std::size_t changes =
        cleanup::raise_worth(mesh, options_.smoothing, {mesh, std::size_t(to_climb_)}) + lift_worst(mesh);
    attempts_.spend(mesh.work() - spent);
    if (changes == 0) return;
    attempts_.raise_corners(mesh, options_.smoothing);
    const Worth before = attempts_.judge(best.mesh), after = attempts_.judge(mesh);
    if (after.sum() <= before.sum() || after.least < std::min(before.least, Worth::kGoodEnough)) return;
    if (find_fault(mesh, region_, plane_)) return;
    best.mesh = std::move(mesh);
    if (wants_stages(best.options)) best.record.stages[std::size_t(Stage::repair)] = best.mesh;
  }

  /// In the end, whichever attempt it was: rows that lean across a gap, and what is around poor quads by an exact
  /// search.
  void refill(Attempt& best) {
    if (best.fault || plane_.curved || !cleanup::has_poor_quads(best.mesh)) return;
    kernel::Mesh mesh = best.mesh;
    const std::size_t spent = mesh.work();
    const kernel::Budget budget(mesh, std::size_t(std::max(0.0, budget_.left())));
    const std::size_t changes = bands::relay_leaning_rows(mesh, options_.smoothing, budget) +
                                cleanup::refill_around_poor(mesh, options_.smoothing, budget);
    attempts_.spend(mesh.work() - spent);
    if (changes == 0) return;
    if (attempts_.is_small()) attempts_.raise_corners(mesh, options_.smoothing);
    if (attempts_.judge(mesh).least < attempts_.judge(best.mesh).least || find_fault(mesh, region_, plane_)) return;
    best.mesh = std::move(mesh);
    if (wants_stages(best.options)) best.record.stages[std::size_t(Stage::repair)] = best.mesh;
  }

  /// A search around the worst quad, where that may help. Returns the number of changes.
  std::size_t lift_worst(kernel::Mesh& mesh) const {
    constexpr double kBoundaryIsPoor = 0.3;  // under that it nearly always is, and nothing was found
    constexpr std::size_t kFew = 150;        // triangles: in larger regions it costs much and brings little
    const double allowed = std::min({kWorkToLift * double(region_.triangles.size()), kMostToLift, attempts_.left()});
    if (allowed <= 0 || region_.triangles.size() > kFew || attempts_.judge(mesh).least < kBoundaryIsPoor) return 0;
    const std::size_t changes = cleanup::lift_worst(mesh, options_.smoothing, {mesh, std::size_t(allowed)});
    if (changes > 0) smoothing::smooth(mesh, options_.smoothing);
    return changes;
  }

  bool is_good(const Worth& worth) const {
    constexpr double kGood = 2.16, kGoodInChart = 2.05;
    return !worth.is_poor() && (!attempts_.is_small() || worth.sum() > (plane_.curved ? kGoodInChart : kGood));
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
    const std::size_t before = attempts_.cost(),
                      most_work = is_quick ? kWorkForAnyTries + kWorkForTries * size : kWorkIfPoor * size;
    for (; next_variant_ < variants.size(); ++next_variant_) {
      const Options& options = variants[next_variant_];
      if ((next_variant_ + 2) * size > most_triangles || attempts_.cost() - before > most_work) break;
      if (double(best.mesh.work()) > attempts_.left()) {
        ++best.report.budgets_spent;
        break;
      }
      if (attempts_.would_repeat(options.front)) continue;
      budget_.spend(double(kWorkToBegin + kWorkToAdvance * size));
      Attempt other = attempts_.begin(attempts_.start(), options, attempts_.left(), Way::one_of_many, is_quick);
      if (!other.fault && count_faces(other.mesh, 4) <= most_faces) tries.push_back(std::move(other));
    }
  }

  const Region& region_;
  const Plane& plane_;
  const Options& options_;
  Budget& budget_;
  const Tries tries_;
  RegionAttempts attempts_;
  const double to_climb_;         ///< work that is kept for climb()
  std::size_t next_variant_ = 0;  ///< of front_variants()
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
