// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The local changes of connectivity that cleanup chooses from.

#include <vector>

#include "cleanup/score.hpp"
#include "kernel/mesh.hpp"

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

}  // namespace qmorph::cleanup
