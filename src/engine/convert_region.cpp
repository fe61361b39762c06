// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/convert_region.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "bands/lay_rows.hpp"
#include "engine/ear.hpp"
#include "engine/fans.hpp"
#include "engine/parts/convert_parts.hpp"
#include "engine/prepare.hpp"
#include "qmorph/error.hpp"
#include "smoothing/corner_energy.hpp"

namespace qmorph {
namespace {

/// What the stages made of a region.
struct Attempt {
  kernel::Mesh mesh;
  ConversionReport report{};
  Record record{};
  std::optional<SurfaceError> fault{};
};

/// The element's worst corner, with edges a and b: 4 a x b / (a^2 + b^2 + (a - b)^2), 1 in a square. Thesis, eq. 2.1
/// and 2.2.
double shape(const kernel::Mesh& mesh, Index f) {
  double least = 1;
  Index h = mesh.half_edge(f);
  for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h)) {
    const Vec2 a = mesh.vector(h), b = -mesh.vector(mesh.prev(h));
    least = std::min(least, 4 * cross(a, b) / (a.squaredNorm() + b.squaredNorm() + (a - b).squaredNorm()));
  }
  return least;
}

struct Worth {
  double least = 1;   ///< smallest scaled Jacobian of a quad
  double mean = 0;    ///< of shapes
  double growth = 0;  ///< quads over those that take the place of equilateral triangles with sides as long
  /// Once the worst quad is good enough for every solver, it counts for little, and the others count. Many quads that
  /// are smaller than asked for have good shapes easily, so growth counts against a result.
  double sum() const {
    constexpr double kLittle = 0.1, kFairGrowth = 1.25;
    return std::min(least, kGoodEnough) + kLittle * std::clamp(least - kGoodEnough, 0.0, kFine - kGoodEnough) +
           2 * mean - std::max(0.0, growth - kFairGrowth);
  }
  bool is_poor() const { return least < kFine; }
  static constexpr double kGoodEnough = 0.4, kFine = 0.7;
};

/// `triangles`: how many the region had.
Worth worth_of(const kernel::Mesh& mesh, std::size_t triangles) {
  constexpr double kTrianglesPerQuad = 2.31;  // of the same sides: 4 / sqrt(3)
  Worth worth;
  std::size_t faces = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    if (mesh.is_quad(f)) worth.least = std::min(worth.least, mesh.smallest_sine(f));
    worth.mean += shape(mesh, f), ++faces;
  }
  if (faces > 0) worth.mean /= double(faces);
  worth.growth = kTrianglesPerQuad * double(faces) / double(triangles);
  return worth;
}

/// The options that the caller asked for, with other constants of the front.
std::vector<Options> variants_of(const Options& asked) {
  std::vector<Options> variants;
  for (double corner : {1.0, 0.9, 1.1})
    for (double side : {1.0, 0.5, 1.5})
      for (double transition : {1.0, 0.7})
        for (double seam : {1.0, 0.5}) {
          Options options = asked;
          options.front.corner_angle *= corner;
          options.front.side_edge_angle *= side;
          options.front.transition_ratio *= transition;
          options.front.seam_angle *= seam;
          options.front.seam_angle_many *= seam;
          variants.push_back(options);
        }
  variants.erase(variants.begin());  // as asked
  return variants;
}

bool is_small(const Region& region, const Options& options) {
  return 2 * region.triangles.size() <= options.retry_triangles;
}

/// Whether so many triangles are few enough for other constants of the front.
bool may_try_again(std::size_t triangles, const Options& options) { return triangles <= 2 * options.retry_triangles; }

/// A front that was finished, and what it has cost.
struct Front {
  front::Decisions decisions;
  std::uint64_t fingerprint;  ///< of what it has made
  std::size_t front_work, finish_work;
};

/// What an attempt costs however small the region is.
constexpr std::size_t kWorkPerAttempt = 200;

class RegionConverter {
 public:
  /// `allowed`: work that all attempts together may cost, more or less.
  RegionConverter(const Region& region, const Plane& plane, const Options& options, double allowed)
      : region_(region), plane_(plane), options_(options), is_small_(is_small(region, options)), allowed_(allowed) {
    start();
  }

  Attempt run() {
    std::optional<SurfaceError> fault = find_needles(start_, plane_);
    if (!fault) {
      if (auto parts = attempt_in_parts()) return std::move(*parts);
      const std::size_t size = count_faces(start_, 3);  // fans may have been refined
      constexpr std::size_t kFewest = 3;                // with fewer a front has no choice
      const bool has_tries = size >= kFewest && may_try_again(size, options_);
      Attempt first = attempt(has_tries ? start_ : std::move(start_), options_, allowed_, true);
      if (!first.fault) {
        take_rows(first);
        return has_tries ? best_of_variants(std::move(first), size) : std::move(first);
      }
      fault = first.fault;
      if (!has_tries) start();
    }
    // A front has no room in fans and needles. Pairing the triangles as they are often has.
    Attempt paired = attempt(std::move(start_), options_, allowed_ - double(cost_), false);
    if (paired.fault) throw *fault;
    return paired;
  }

  /// Of all attempts so far.
  std::size_t cost() const { return cost_; }

 private:
  /// Makes the mesh that the front begins with.
  void start() {
    start_ = kernel::Mesh(region_.points, region_.triangles, region_.open);
    for (Index v : region_.fixed) start_.set_fixed(v);
    if (wants_stages(options_)) input_ = start_;
    repair_input(start_, region_.node, plane_);
    grade_fans(start_);
  }

  Worth judge(const kernel::Mesh& mesh) const { return worth_of(mesh, region_.triangles.size()); }

  /// A thin band as rows, if they are worth more.
  void take_rows(Attempt& best) {
    const std::optional<bands::Band> band = bands::find_band(region_);
    if (!band) return;
    constexpr double kAsGood = 0.01, kFair = 0.5;
    for (const bands::RowCosts& costs : {bands::kBetterTurns, bands::kFewerTurns}) {
      auto rows = bands::lay_rows(*band, region_.points, costs);
      if (!rows || double(cost_) > allowed_) return;
      Attempt laid = attempt(std::move(*rows), options_, allowed_ - double(cost_), false);
      const Worth one = judge(laid.mesh), other = judge(best.mesh);
      // A poor quad more is too high a price for rows.
      if (laid.fault || one.sum() <= other.sum() || one.least < std::min(other.least - kAsGood, kFair)) continue;
      best = std::move(laid);
    }
  }

  /// `size`: triangles that the front begins with.
  Attempt best_of_variants(Attempt best, std::size_t size) {
    // Under the lower bound it is the boundary that is poor, and no try changes that.
    constexpr double kGood = 2.05, kHopeless = 0.1;
    constexpr std::size_t kMostGrowth = 2, kFew = 20;  // a front that makes many more faces than that has gone astray
    std::size_t triangles = size;
    // A poor quad is worth some tries in a region that is not so small, too.
    constexpr std::size_t kTries = 6;
    Worth worth = judge(best.mesh);
    if (worth.least < kHopeless || (!is_small_ && !worth.is_poor())) return best;
    const std::size_t most = std::max(options_.retry_triangles, worth.is_poor() ? kTries * size : 0);
    // Where a boundary is all spikes, an attempt may cost ten times as much as usual, and none is better.
    constexpr std::size_t kWorkPerTriangle = 2000;
    const std::size_t first = cost_;  // of the first attempt; each other one costs about as much
    for (const Options& options : variants_of(options_)) {
      triangles += size;
      if (triangles > most || (worth.sum() > kGood && !worth.is_poor())) break;
      if (cost_ > kWorkPerTriangle * most) break;
      if (double(cost_ + first) > allowed_) {
        ++best.report.budgets_spent;
        break;
      }
      if (const Front* same = made_before(options.front)) {
        cost_ += same->front_work + same->finish_work;
        continue;
      }
      Attempt other = attempt(start_, options, allowed_ - double(cost_ - first), true,
                              kMostGrowth * (count_faces(best.mesh, 4) + kFew));
      const Worth others = judge(other.mesh);
      if (other.fault || others.sum() <= worth.sum()) continue;
      best = std::move(other);
      worth = others;
    }
    return best;
  }

  Attempt attempt(kernel::Mesh mesh, const Options& options, double allowed, bool with_front,
                  std::size_t most_faces = std::size_t(-1)) {
    Attempt result{std::move(mesh)};
    result.mesh.add_work(kWorkPerAttempt);
    Options final = options;
    if (is_small_) final.smoothing.good_quality = 0;  // raise_corners() tries what pays
    Pipeline pipeline(final, result.report, result.record, input_, allowed);
    // Without a second try there is nothing to compare with.
    const bool notes_fronts = with_front && may_try_again(region_.triangles.size(), options_);
    Front front{};
    if (with_front) pipeline.advance_front(result.mesh, plane_, notes_fronts ? &front.decisions : nullptr);
    const std::size_t front_work = result.mesh.work();
    cost_ += front_work;
    if (count_faces(result.mesh, 3) + count_faces(result.mesh, 4) > most_faces) {
      result.fault = SurfaceError("too many elements");
      return result;
    }
    front.front_work = front_work;
    if (notes_fronts) {
      front.fingerprint = result.mesh.fingerprint();
      const auto same = std::find_if(finished_.begin(), finished_.end(),
                                     [&](const Front& other) { return other.fingerprint == front.fingerprint; });
      if (same != finished_.end()) {
        result.fault = SurfaceError("the front has made this before");
        cost_ += front.finish_work = same->finish_work;
        finished_.push_back(front);
        return result;
      }
    }
    pipeline.finish(result.mesh);
    cost_ += front.finish_work = result.mesh.work() - front_work;
    if (notes_fronts) finished_.push_back(front);
    if (is_small_) raise_corners(result.mesh, options.smoothing);
    if (is_small_ && wants_stages(options)) result.record.stages[std::size_t(Stage::repair)] = result.mesh;
    result.fault = find_fault(result.mesh, region_, plane_);
    return result;
  }

  /// The finished front that these constants would repeat, or null.
  const Front* made_before(const FrontOptions& options) const {
    for (const Front& front : finished_)
      if (front.decisions.would_be_same(options)) return &front;
    return nullptr;
  }

  /// Nothing if the region is not large, or has no valid result in parts.
  std::optional<Attempt> attempt_in_parts() {
    if (!is_large(region_.triangles.size(), options_)) return {};
    Attempt result;
    auto mesh = convert_in_parts(std::move(start_), input_, plane_, options_, allowed_, result.report, result.record);
    if (mesh) {
      cost_ += mesh->work();
      result.mesh = std::move(*mesh);
      if (!find_fault(result.mesh, region_, plane_)) return result;
    }
    start();
    return {};
  }

  /// Raises the corners that are not good enough, or as many as asked for if the others do not lose more by it.
  void raise_corners(kernel::Mesh& mesh, const SmoothingOptions& smoothing) const {
    if (smoothing.method != SmoothingMethod::shape_energy) return;
    const kernel::Mesh start = mesh;
    for (double good : {Worth::kGoodEnough, smoothing.good_quality}) {
      SmoothingOptions options = smoothing;
      options.good_quality = std::min(good, smoothing.good_quality);
      kernel::Mesh raised = start;
      smoothing::raise_worst_corners(raised, options);
      if (judge(raised).sum() > judge(mesh).sum()) mesh = std::move(raised);
    }
  }

  const Region& region_;
  const Plane& plane_;
  const Options& options_;
  const bool is_small_;  ///< so that a second try is allowed
  const double allowed_;
  std::size_t cost_ = 0;
  std::vector<Front> finished_;
  kernel::Mesh start_;  ///< what the front begins with
  kernel::Mesh input_;  ///< as it came, if stages are measured
};

/// The same with an ear set aside: the one triangle that an odd boundary leaves. Adds what that cost.
std::optional<Attempt> convert_without_ear(const Region& region, const Plane& plane, const Options& options,
                                           double allowed, std::size_t& cost) {
  if (region.boundary_sides % 2 == 0 || !is_small(region, options) || allowed <= 0) return {};
  const std::optional<Ear> ear = sharpest_ear(region);
  if (!ear) return {};
  try {
    const Region rest = cut_off(region, *ear);
    RegionConverter converter(rest, plane, options, allowed);
    Attempt result = converter.run();
    cost += converter.cost();
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

kernel::Mesh convert_region(const Region& region, const Plane& plane, const Options& options, double allowed,
                            ConversionReport& report, Record& record) {
  const std::size_t size = region.triangles.size();
  RegionConverter converter(region, plane, options, allowed);
  Attempt best = converter.run();
  std::size_t cost = converter.cost();
  if (auto other = convert_without_ear(region, plane, options, allowed - double(cost), cost))
    if (worth_of(other->mesh, size).sum() > worth_of(best.mesh, size).sum()) best = std::move(*other);
  best.mesh.add_work(cost - best.mesh.work());
  report = best.report;
  record = std::move(best.record);
  return std::move(best.mesh);
}

}  // namespace qmorph
