// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Which fillings would give a cavity better valences.

#include <vector>

#include "cleanup/cavity.hpp"
#include "cleanup/filling.hpp"
#include "cleanup/pair_filling.hpp"
#include "cleanup/score.hpp"

namespace qmorph::cleanup {

struct FillingChoice {
  Filling filling;
  std::optional<PairFilling> pair;  ///< if there is one, this instead
  double cost = 0;                  ///< score of the outline's nodes and the new ones, after
  double misfit =
      0;  ///< how far the angles of the outline are from those that the filling asks for, squared, in half turns
};

struct FillingChoices {
  std::vector<FillingChoice> best_first;
  bool depends_on_size = false;  ///< with another `quads_wanted` there would be more
};

/// A first look that needs no angles: false if every filling costs more than `most_cost`, which is the case five times
/// out of six.
bool may_have_filling(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity, double most_cost);

/// Of all fillings of the whole mesh, if its boundary is one loop, none has a smaller misfit. Cost: the nodes.
double least_misfit(const kernel::Mesh& mesh, const Score& score);

/// Fillings of the cavity that cost `most_cost` at most and whose number of quads is near `quads_wanted`. Cost: n log n
/// for an outline of n edges.
FillingChoices choose_fillings(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity, double most_cost,
                               double quads_wanted, const FillingSize& size = {});

}  // namespace qmorph::cleanup
