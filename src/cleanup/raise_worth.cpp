// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/raise_worth.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "cleanup/attempt.hpp"
#include "kernel/sort_unique.hpp"

namespace qmorph::cleanup {
namespace {

/// Quads whose worst corner has a smaller sine are places to begin at; the nodes of so many rings around are near.
constexpr double kPlace = 0.85;
constexpr int kNearRings = 2;
/// Corners with a smaller sine are poor: one of sine 0 counts as much as so many quads that are worth nothing.
constexpr double kPoor = 0.5, kPriceOfPoor = 4;
/// Of the valence score, in quads that are worth nothing.
constexpr double kPriceOfScore = 0.6;
/// What a change has to bring, in quads; and what may be missing after so many passes of the relaxation, which will
/// not be made up for.
constexpr double kLeastGain = 0.1, kMissing = 0.5;
constexpr int kLookAt = 2;
/// How many changes are tried alone, as first ones and as second ones, and what they may cost of the valence score.
constexpr std::size_t kMostAlone = 16, kMostFirst = 10, kMostSecond = 6;
constexpr int kLeastScore = -6;
constexpr int kRings = 1;  ///< that are relaxed around a change
/// Of a change that is made and taken back, for each face around it.
constexpr std::size_t kWorkToTry = 3;

/// Of a search: so many changes at random at most before each climb, what one may cost of the valence score, and one in
/// so many of them is a row of quads around a quad.
constexpr std::size_t kMostAtRandom = 5, kOneIsPillow = 6;
constexpr int kLeastAtRandom = -12;
/// What a climb may cost, how many rings are relaxed after it, by what the worst corner has to get better, and how many
/// times as many elements are no drawback.
constexpr std::size_t kWorkOfClimb = 20'000;
constexpr int kRingsOfClimb = 3;
constexpr double kLeastLift = 0.02, kFairGrowth = 1.2;

/// Some elements' part in what the mesh is worth.
struct Sum {
  double shape = 0, poor = 0, worst = 1;
  std::size_t count = 0;
  int score = 0;  ///< of the nodes
};

class Climbing {
 public:
  Climbing(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget)
      : mesh_(mesh), score_(mesh), relaxing_(smoothing), budget_(budget) {
    relaxing_.iterations = 8;
    relaxing_.untangling_sweeps = 8;
    for (Index f = 0; f < mesh_.face_slots(); ++f)
      if (mesh_.is_live_face(f)) add(f, all_);
    for (Index v = 0; v < mesh_.vertex_slots(); ++v)
      if (mesh_.is_live_vertex(v)) all_.score += score_.cost(v);
  }

  std::size_t run() {
    climb([&] { failed_.assign(mesh_.face_slots(), false); });
    return changes_;
  }

  /// The same, but it begins at the faces around these nodes only.
  void run_near(const std::vector<Index>& nodes) {
    climb([&] {
      failed_.assign(mesh_.face_slots(), true);
      forgive(nodes);
    });
  }

  /// Of the whole mesh as it was at the beginning.
  const Sum& all() const { return all_; }

 private:
  /// `start` says at which faces.
  template <class Start>
  void climb(const Start& start) {
    for (bool in_twos : {false, true}) {
      start();
      for (Index f = worst_place(); f != kNone && !budget_.is_spent(); f = worst_place())
        if (in_twos ? improve_by_two(f) : improve(f))
          ++changes_;
        else
          failed_[f] = true;
    }
  }

  /// One change or two: action and half-edges of each.
  using Tried = std::array<Index, 6>;

  /// The quad with the worst corner of those that nothing was found for, or kNone.
  Index worst_place() {
    constexpr std::size_t kLooksPerWork = 8;
    mesh_.add_work(mesh_.face_slots() / kLooksPerWork);
    failed_.resize(mesh_.face_slots(), false);
    double least = kPlace;
    Index worst = kNone;
    for (Index f = 0; f < mesh_.face_slots(); ++f) {
      if (!mesh_.is_live_face(f) || !mesh_.is_quad(f) || failed_[f] || mesh_.is_above(f, least)) continue;
      least = mesh_.smallest_sine(f), worst = f;
    }
    return worst;
  }

  void add(Index f, Sum& sum) const {
    sum.shape += topology::worst_corner_shape(mesh_, f);
    const double sine = mesh_.smallest_sine(f);
    sum.poor += std::max(0.0, kPoor - sine) / kPoor;
    sum.worst = std::min(sum.worst, sine);
    ++sum.count;
  }

  int score_of(const std::vector<Index>& nodes) const {
    int score = 0;
    for (Index v : nodes)
      if (mesh_.is_live_vertex(v)) score += score_.cost(v);
    return score;
  }

  Sum sum_of(const std::vector<Index>& faces, const std::vector<Index>& nodes) const {
    Sum sum;
    for (Index f : faces) add(f, sum);
    sum.score = score_of(nodes);
    mesh_.add_work(faces.size());
    return sum;
  }

  /// In quads, if `before` becomes `after`.
  double gain(const Sum& before, const Sum& after) const {
    const double n = double(all_.count), shape = all_.shape - before.shape + after.shape;
    return n * shape / (n - double(before.count) + double(after.count)) - all_.shape +
           kPriceOfPoor * (before.poor - after.poor) + kPriceOfScore * (before.score - after.score);
  }

  bool is_better(const Sum& after) const {
    return gain(before_, after) > kLeastGain && after.worst >= std::min(before_.worst, kPoor);
  }

  /// Whether a change is to be relaxed: it is if it might be better wherever nodes went, and no other has made the same
  /// elements since something has changed.
  bool has_chance(const std::vector<Index>& faces, const std::vector<Index>& around, const std::vector<Index>& nodes) {
    mesh_.add_work(kWorkToTry * faces.size());
    Sum ideal;
    ideal.shape = double(faces.size()), ideal.count = faces.size();
    ideal.worst = best_worth_around(mesh_, nodes).worst;
    ideal.score = score_of(around);
    return is_better(ideal) && relaxed_.insert(topology::connectivity(mesh_, faces) - connectivity_).second;
  }

  void start_at(Index f) {
    near_.clear();
    for (Index g : topology::grow(mesh_, {f}, kNearRings))
      for (Index v : topology::nodes_of(mesh_, g)) near_.push_back(v);
    sort_unique(near_);
    const std::vector<Index> faces = topology::faces_around(mesh_, near_);
    before_ = sum_of(faces, near_);
    connectivity_ = topology::connectivity(mesh_, faces);
  }

  /// Whether this change, or these two, have not been tried since something has changed: several quads share a node.
  bool is_new(const Candidate& first, const Candidate* second) {
    Tried tried{Index(first.action), first.h, first.k, kNone, kNone, kNone};
    if (second) tried[3] = Index(second->action), tried[4] = second->h, tried[5] = second->k;
    return tried_.insert(tried).second;
  }

  bool improve(Index f) {
    start_at(f);
    for (const Candidate& c : best_candidates(mesh_, score_, topology::nodes_of(mesh_, f), kLeastScore, kMostAlone)) {
      if (budget_.is_spent()) return false;
      if (is_new(c, nullptr) && keep_if_better([&](std::vector<Index>& nodes) { return apply(mesh_, c, nodes); }))
        return true;
    }
    return false;
  }

  bool improve_by_two(Index f) {
    start_at(f);
    return try_two_changes(
        mesh_, score_, topology::nodes_of(mesh_, f), {kLeastScore, kMostFirst, kMostSecond}, budget_,
        [&](const Candidate& first, const Candidate& second) { return is_new(first, &second); },
        [&](const auto& edit) { return keep_if_better(edit); });
  }

  /// `edit` appends the nodes around what it changes.
  template <class Edit>
  bool keep_if_better(const Edit& edit) {
    std::vector<Index> nodes, around;
    Sum after;
    mesh_.begin();
    bool kept = edit(nodes);
    if (kept) {
      topology::remove_doublets(mesh_, nodes);
      around = near_;
      around.insert(around.end(), nodes.begin(), nodes.end());
      sort_unique(around);
      const std::vector<Index> faces = topology::faces_around(mesh_, around);
      const auto is_hopeful = [&](int pass) {
        return pass != kLookAt || gain(before_, sum_of(faces, around)) > -kMissing;
      };
      kept = has_chance(faces, around, nodes) && smoothing::smooth_near(mesh_, relaxing_, nodes, kRings, is_hopeful);
      if (kept) after = sum_of(faces, around), kept = is_better(after);
    }
    kept ? mesh_.commit() : mesh_.rollback();
    if (!kept) return false;
    all_.shape += after.shape - before_.shape;
    all_.poor += after.poor - before_.poor;
    all_.score += after.score - before_.score;
    all_.count += after.count - before_.count;
    forgive(around);
    tried_.clear(), relaxed_.clear();
    return true;
  }

  /// Where something has changed, what failed before may succeed.
  void forgive(const std::vector<Index>& nodes) {
    failed_.resize(mesh_.face_slots(), false);
    for (Index f : topology::faces_around(mesh_, nodes)) failed_[f] = false;
  }

  kernel::Mesh& mesh_;
  Score score_;
  SmoothingOptions relaxing_;
  const kernel::Budget& budget_;
  Sum all_, before_;                ///< of the whole mesh, and near the quad that is at hand
  std::vector<Index> near_;         ///< nodes of what may change there
  std::uint64_t connectivity_ = 0;  ///< near that quad
  std::set<Tried> tried_;
  std::set<std::uint64_t> relaxed_;  ///< changes of the connectivity that were
  std::vector<bool> failed_;         ///< faces around which nothing has changed since nothing was found for them
  std::size_t changes_ = 0;
};

/// Changes at random around the worst quad, a climb from there, and back if that did not lift it.
class Lift {
 public:
  Lift(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget)
      : mesh_(mesh), smoothing_(smoothing), budget_(budget) {
    const Sum start = measure(mesh_);
    elements_ = start.count, worth_ = worth(start), worst_ = start.worst;
  }

  std::size_t run() {
    std::size_t kept = 0;
    while (worst_ < kPoor && !budget_.is_spent()) {
      kernel::Mesh trial = mesh_;
      trial.add_work(trial.face_slots());
      if (const std::vector<Index> nodes = change_at_random(trial); !nodes.empty()) {
        Climbing(trial, smoothing_, {trial, kWorkOfClimb}).run_near(nodes);
        relax(trial, nodes);
        if (accept(measure(trial))) {
          mesh_ = std::move(trial);
          ++kept;
          continue;
        }
      }
      mesh_.add_work(trial.work() - mesh_.work());
    }
    return kept;
  }

 private:
  Sum measure(kernel::Mesh& mesh) const { return Climbing(mesh, smoothing_, budget_).all(); }

  /// In quads as good as can be.
  double worth(const Sum& sum) const {
    const double n = double(elements_), count = double(sum.count);
    return n * (sum.shape / count - std::max(0.0, count / n - kFairGrowth)) - kPriceOfPoor * sum.poor -
           kPriceOfScore * sum.score;
  }

  bool accept(const Sum& found) {
    if (worth(found) <= worth_ || found.worst < std::min(worst_ + kLeastLift, kPoor)) return false;
    worth_ = worth(found), worst_ = found.worst;
    return true;
  }

  /// One below `count`.
  std::size_t any_of(std::size_t count) { return random_() % count; }

  /// Nodes of the worst quad and of those around it.
  static std::vector<Index> places(const kernel::Mesh& mesh) {
    Index worst = kNone;
    for (Index f = 0; f < mesh.face_slots(); ++f)
      if (mesh.is_live_face(f) && mesh.is_quad(f) &&
          (worst == kNone || mesh.smallest_sine(f) < mesh.smallest_sine(worst)))
        worst = f;
    std::vector<Index> nodes;
    if (worst == kNone) return nodes;
    for (Index f : topology::grow(mesh, {worst}, 1))
      for (Index v : topology::nodes_of(mesh, f)) nodes.push_back(v);
    sort_unique(nodes);
    return nodes;
  }

  /// Some changes, each beside the one before. The nodes around them; none if nothing was possible.
  std::vector<Index> change_at_random(kernel::Mesh& mesh) {
    const Score score(mesh);
    std::vector<Index> near = places(mesh), changed;
    for (std::size_t left = 1 + any_of(kMostAtRandom); left > 0 && !near.empty(); --left) {
      std::vector<Index> nodes;
      mesh.begin();
      bool kept = change(mesh, score, near[any_of(near.size())], nodes);
      if (kept) {
        topology::remove_doublets(mesh, nodes);
        kept = smoothing::smooth_near(mesh, smoothing_, nodes, kRings);
      }
      kept ? mesh.commit() : mesh.rollback();
      if (!kept) continue;
      changed.insert(changed.end(), nodes.begin(), nodes.end());
      topology::keep_live(mesh, changed);
      near = std::move(nodes);
      topology::keep_live(mesh, near);
    }
    return changed;
  }

  bool change(kernel::Mesh& mesh, const Score& score, Index v, std::vector<Index>& nodes) {
    if (mesh.valence(v) > kMostValence) return false;
    if (any_of(kOneIsPillow) == 0) {
      const std::vector<Index> around = topology::faces_around(mesh, {v});
      const Index quad = around[any_of(around.size())];
      nodes = topology::nodes_of(mesh, quad);
      return mesh.is_quad(quad) && topology::pillow(mesh, {quad}, nodes);
    }
    const std::vector<Candidate> candidates = candidates_around(mesh, score, v, kLeastAtRandom);
    return !candidates.empty() && apply(mesh, candidates[any_of(candidates.size())], nodes);
  }

  void relax(kernel::Mesh& mesh, std::vector<Index> nodes) const {
    topology::keep_live(mesh, nodes);
    mesh.begin();
    smoothing::smooth_near(mesh, smoothing_, nodes, kRingsOfClimb) ? mesh.commit() : mesh.rollback();
  }

  kernel::Mesh& mesh_;
  const SmoothingOptions& smoothing_;
  const kernel::Budget& budget_;
  std::size_t elements_ = 0;  ///< at the beginning
  double worth_ = 0, worst_ = 1;
  std::mt19937 random_;  // with the same seed each time
};

}  // namespace

std::size_t lift_worst(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget) {
  return Lift(mesh, smoothing, budget).run();
}

std::size_t raise_worth(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget) {
  return Climbing(mesh, smoothing, budget).run();
}

}  // namespace qmorph::cleanup
