// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/repair.hpp"

#include <algorithm>
#include <numbers>

#include "cleanup/attempt.hpp"
#include "kernel/sort_unique.hpp"
#include "smoothing/untangle.hpp"

namespace qmorph::cleanup {
namespace {

constexpr int kPasses = 3;
/// Changes may cost this much of the valence score: shape comes first here.
constexpr int kLeastGain = -6;
constexpr int kMostCandidates = 16;
/// Below this sine two changes are tried together: so many first ones, each with so many second ones, which together
/// cost this much of the score at most.
constexpr double kPoor = 0.45;
constexpr std::size_t kMostFirst = 12, kMostSecond = 12;
constexpr int kLeastGainOfTwo = -10;
constexpr int kRings = 2;
/// A corner of an element that the boundary keeps nearer to straight than to right is bad, whatever its sine.
constexpr double kStrained = 135 * std::numbers::pi / 180;
/// Of the changes that are kept, nearly all are valid at once; none was seen that took more than eleven sweeps.
constexpr int kUntanglingSweeps = 12;
/// Of a bad face: all changes and layers around it.
constexpr std::size_t kUsualWork = 20'000;
/// Elements that are tried after the budget is spent because they are invalid: some, and a share of all.
constexpr std::size_t kFewOverdrafts = 50;
constexpr double kMostOverdrafts = 0.05;

/// A repair has to pay: a slightly better corner is not worth irregular nodes.
bool is_clearly_better(const Worth& before, const Worth& after) {
  constexpr double kFactor = 1.5, kStep = 0.1, kFair = 0.3;
  if (before.worst > kFair) return after.worst > before.worst + kStep;
  return after.worst > kFactor * before.worst && after.worst > before.worst + std::min(kStep, before.worst);
}

class Repair {
 public:
  Repair(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget)
      : mesh_(mesh),
        score_(mesh),
        relaxing_(smoothing),
        budget_(budget),
        most_overdrafts_(kFewOverdrafts + std::size_t(kMostOverdrafts * double(mesh.face_slots()))) {
    relaxing_.iterations = std::max(relaxing_.iterations, 12);
    relaxing_.untangling_sweeps = kUntanglingSweeps;
  }

  std::size_t run() {
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::size_t before = changes_;
      if (const std::vector<Index> bad = bad_faces(); budget_.is_short_for(bad.size(), kUsualWork))
        try_faces(worst_first(mesh_, bad));
      else
        for (Index f = 0; f < mesh_.face_slots(); ++f) try_face(f);
      if (changes_ == before || budget_.is_spent()) break;
    }
    return changes_;
  }

  std::size_t run_in_twos() {
    std::vector<Index> poor;
    for (Index f = 0; f < mesh_.face_slots(); ++f)
      if (is_poor(f)) poor.push_back(f);
    for (Index f : worst_first(mesh_, poor)) {
      if (budget_.is_spent()) break;
      if (is_poor(f)) changes_ += improve_by_two(f);
    }
    return changes_;
  }

 private:
  bool is_poor(Index f) const {
    return mesh_.is_live_face(f) && mesh_.degree(f) == 4 && !mesh_.is_above(f, kPoor) && !has_high_corner(f);
  }

  bool has_high_corner(Index f) const {
    return has_corner(f, [&](Index v) { return mesh_.valence(v) > kMostValence; });
  }

  bool is_bad(Index f) const {
    if (!mesh_.is_live_face(f) || mesh_.degree(f) != 4) return false;
    if (mesh_.is_above(f, relaxing_.target_quality) && !is_at_strained_corner(f)) return false;
    return !has_high_corner(f);
  }

  /// Too few quads share the angle of a corner of the boundary, so that no smoothing can help them.
  bool is_at_strained_corner(Index f) const {
    return has_corner(f, [&](Index v) {
      return mesh_.is_boundary(v) && score_.excess(v) < 0 &&
             score_.inside_angle(v) > kStrained * double(mesh_.valence(v) - 1);
    });
  }

  template <class Test>
  bool has_corner(Index f, const Test& test) const {
    bool found = false;
    mesh_.for_nodes_of(f, [&](Index v) { found = found || test(v); });
    return found;
  }

  /// An invalid element is worth a try though the budget is spent, as long as such elements are not the rule.
  bool may_try(Index f) {
    if (!budget_.is_spent()) return true;
    return overdrafts_ < most_overdrafts_ && mesh_.is_live_face(f) && !mesh_.is_valid_face(f);
  }

  bool has_failed(Index f) const { return f < failed_.size() && failed_[f]; }

  std::vector<Index> bad_faces() const {
    std::vector<Index> bad;
    for (Index f = 0; f < mesh_.face_slots(); ++f)
      if (is_bad(f) && !has_failed(f)) bad.push_back(f);
    return bad;
  }

  void try_faces(const std::vector<Index>& faces) {
    for (Index f : faces) try_face(f);
  }

  void try_face(Index f) {
    if (!may_try(f) || !is_bad(f) || has_failed(f)) return;
    overdrafts_ += budget_.is_spent();
    if (improve(f)) {
      ++changes_;
      for (Index v : nodes_) forgive_around(v);
    } else {
      failed_.resize(mesh_.face_slots(), false);
      failed_[f] = true;
    }
  }

  /// Where something has changed, what failed before may succeed.
  void forgive_around(Index v) {
    if (!mesh_.is_live_vertex(v)) return;
    for (Index h : mesh_.around(v)) {
      const Index f = mesh_.face(h);
      if (f != kNone && f < failed_.size()) failed_[f] = false;
    }
  }

  bool improve(Index f) {
    const std::vector<Index> corners = topology::nodes_of(mesh_, f);
    const std::vector<Candidate> candidates = best_candidates(mesh_, score_, corners, kLeastGain, kMostCandidates);
    for (const Candidate& c : candidates) {
      if (!may_try(f)) return false;
      std::vector<Index> near = nodes_near(mesh_, c);
      near.insert(near.end(), corners.begin(), corners.end());
      if (try_edit(near, [&](std::vector<Index>& nodes) {
            nodes = corners;
            return apply(mesh_, c, nodes);
          }))
        return true;
    }
    for (int rings : {0, 1}) {
      const std::vector<Index> faces = topology::grow(mesh_, {f}, rings);
      std::vector<Index> near;
      for (Index g : faces)
        for (Index v : topology::nodes_of(mesh_, g)) near.push_back(v);
      if (try_edit(near, [&](std::vector<Index>& nodes) {
            nodes = near;
            return topology::pillow(mesh_, faces, nodes);
          }))
        return true;
    }
    return false;
  }

  bool improve_by_two(Index f) {
    std::vector<Index> near;
    for (Index g : topology::grow(mesh_, {f}, 1))
      for (Index v : topology::nodes_of(mesh_, g)) near.push_back(v);
    return try_two_changes(
        mesh_, score_, topology::nodes_of(mesh_, f), {kLeastGainOfTwo, kMostFirst, kMostSecond}, budget_,
        [](const Candidate&, const Candidate&) { return true; },
        [&](const auto& edit) {
          return try_edit(near, [&](std::vector<Index>& nodes) {
            nodes = near;
            return edit(nodes);
          });
        });
  }

  template <class Edit>
  bool try_edit(const std::vector<Index>& near, const Edit& edit) {
    return attempt(mesh_, relaxing_, kRings, near, nodes_, edit, is_clearly_better);
  }

  kernel::Mesh& mesh_;
  Score score_;
  SmoothingOptions relaxing_;
  const kernel::Budget& budget_;
  std::vector<Index> nodes_;
  std::vector<bool> failed_;  ///< faces around which nothing has changed since nothing was found for them
  std::size_t changes_ = 0;
  const std::size_t most_overdrafts_;
  std::size_t overdrafts_ = 0;  ///< invalid elements that were tried after the budget was spent
};

}  // namespace

std::size_t repair(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget) {
  return Repair(mesh, smoothing, budget).run();
}

std::size_t repair_in_twos(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget) {
  return Repair(mesh, smoothing, budget).run_in_twos();
}

}  // namespace qmorph::cleanup
