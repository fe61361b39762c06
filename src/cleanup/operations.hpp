// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The local changes of connectivity that cleanup chooses from.

#include <vector>

#include "cleanup/score.hpp"
#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "topology/edits.hpp"

namespace qmorph::cleanup {

/// Where more edges than this meet, a fan of the input is all there is: a change of one edge does not help, and
/// looking at every pair of edges would be quadratic.
inline constexpr Index kMostValence = 16;

enum class Action {
  close,        ///< merge origin(h) into the node opposite in face(h) [Canann98]
  turn_left,    ///< the edge of h, between two quads, moves on counter-clockwise
  turn_right,   ///< ... clockwise
  open,         ///< open a quad at origin(h) between the edges of h and k
  remove_star,  ///< the three quads around the 3-valent origin(h) become two
};

struct Candidate {
  Action action;
  Index h, k;
  int gain;  ///< how much the score falls, by valences

  bool operator==(const Candidate&) const = default;
};

/// Changes around v that lower the score by at least `least_gain`, best first.
std::vector<Candidate> candidates_around(const kernel::Mesh& mesh, const Score& score, Index v, int least_gain);

/// The first `most` changes around some nodes, best first, without those at nodes of very many edges.
std::vector<Candidate> best_candidates(const kernel::Mesh& mesh, const Score& score, const std::vector<Index>& nodes,
                                       int least_gain, std::size_t most);

/// Carries a change out; topology only. Appends the nodes around it. False, perhaps half-way, if it is
/// impossible: to be called in a transaction.
bool apply(kernel::Mesh& mesh, const Candidate& candidate, std::vector<Index>& nodes);

/// What is tried of two changes together, the first of which alone need not be for the better.
struct TwoChanges {
  int least_gain = 0;  ///< of both
  std::size_t most_first = 0, most_second = 0;
};

/// Tries two changes together around some nodes until one pair is kept. `attempt` is given an edit that appends the
/// nodes around what it changes, and says whether it has kept it; `is_new`, whether a pair is worth that.
template <class IsNew, class Attempt>
bool try_two_changes(kernel::Mesh& mesh, const Score& score, const std::vector<Index>& around, const TwoChanges& limits,
                     const kernel::Budget& budget, const IsNew& is_new, const Attempt& attempt) {
  for (const Candidate& c : best_candidates(mesh, score, around, limits.least_gain, limits.most_first)) {
    std::vector<Candidate> second;  // not known before the first change is made
    for (std::size_t k = 0; k == 0 || k < second.size(); ++k) {
      if (budget.is_spent()) return false;
      const bool is_kept = attempt([&](std::vector<Index>& nodes) {
        if (!apply(mesh, c, nodes)) return false;
        topology::keep_live(mesh, nodes);
        if (k == 0) second = best_candidates(mesh, score, nodes, limits.least_gain - c.gain, limits.most_second);
        return k < second.size() && is_new(c, second[k]) && apply(mesh, second[k], nodes);
      });
      if (is_kept) return true;
    }
  }
  return false;
}

}  // namespace qmorph::cleanup
