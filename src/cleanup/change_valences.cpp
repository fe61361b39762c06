// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/change_valences.hpp"

#include <algorithm>
#include <numeric>

#include "cleanup/attempt.hpp"
#include "cleanup/node_queue.hpp"

namespace qmorph::cleanup {
namespace {

/// A change may lower the smallest sine around it, but not under this (unless it was lower before).
constexpr double kFloor = 0.4;
constexpr int kRings = 2;

class ChangingValences {
 public:
  ChangingValences(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget,
                   Refused* refused = nullptr)
      : mesh_(mesh), score_(mesh), relaxing_(smoothing), budget_(budget), refused_(refused) {
    relaxing_.iterations = 3;
    relaxing_.untangling_sweeps = 8;  // a change that needs more is no improvement
  }

  std::size_t run(const std::vector<Index>& nodes) {
    for (Index v : nodes) enqueue(v);
    std::size_t most = 4 * mesh_.vertex_slots() + 1000;
    while (!queue_.empty() && most-- > 0 && !budget_.is_spent()) {
      const Index v = queue_.pop();
      if (is_defect(v)) improve(v);
    }
    return changes_;
  }

 private:
  bool is_defect(Index v) const { return mesh_.is_live_vertex(v) && score_.excess(v) != 0; }

  void enqueue(Index v) {
    if (is_defect(v)) queue_.push(v);
  }

  void improve(Index v) {
    constexpr int kMostTries = 8;
    int tries = 0;
    if (mesh_.valence(v) > kMostValence) return;
    for (const Candidate& c : candidates_around(mesh_, score_, v, 1)) {
      if (++tries > kMostTries) return;
      if (!attempt_change(c)) continue;
      ++changes_;
      if (refused_) refused_->note_change();
      for (Index u : nodes_)
        if (mesh_.is_live_vertex(u)) {
          enqueue(u);
          for (Index h : mesh_.around(u)) enqueue(mesh_.target(h));
        }
      return;
    }
  }

  bool attempt_change(const Candidate& c) {
    return attempt(
        mesh_, relaxing_, kRings, nodes_near(mesh_, c), nodes_,
        [&](std::vector<Index>& nodes) { return apply(mesh_, c, nodes); },
        [](const Worth& before, const Worth& after) { return after.worst >= std::min(before.worst, kFloor); });
  }

  kernel::Mesh& mesh_;
  Score score_;
  SmoothingOptions relaxing_;
  const kernel::Budget& budget_;
  Refused* const refused_;
  NodeQueue queue_;
  std::vector<Index> nodes_;
  std::size_t changes_ = 0;
};

}  // namespace

std::size_t change_valences(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget,
                            Refused* refused) {
  std::vector<Index> nodes(mesh.vertex_slots());
  std::iota(nodes.begin(), nodes.end(), Index(0));
  return ChangingValences(mesh, smoothing, budget, refused).run(nodes);
}

std::size_t change_valences_near(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const std::vector<Index>& nodes,
                                 const kernel::Budget& budget) {
  return ChangingValences(mesh, smoothing, budget).run(nodes);
}

}  // namespace qmorph::cleanup
