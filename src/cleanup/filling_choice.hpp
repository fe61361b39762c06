// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Which fillings would give a cavity better valences.

#include <vector>

#include "cleanup/cavity.hpp"
#include "cleanup/filling.hpp"
#include "cleanup/score.hpp"

namespace qmorph::cleanup {

struct FillingChoice {
  Filling filling;
  double cost = 0;  ///< score of the outline's nodes and the new ones, after
  double misfit =
      0;  ///< how far the angles of the outline are from those that the filling asks for, squared, in half turns
};

/// A first look that needs no angles: false if every filling costs more than `most_cost`, which is the case five times
/// out of six.
bool may_have_filling(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity, double most_cost);

/// Quads of a filling over quads wanted: a filling that makes the elements coarser or finer than this is not taken.
struct FillingSize {
  double fewest = 0.75, most = 1.7;
};

/// Fillings of the cavity that cost `most_cost` at most and whose number of quads is near `quads_wanted`; best first.
/// Cost: n log n for an outline of n edges.
std::vector<FillingChoice> choose_fillings(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity,
                                           double most_cost, double quads_wanted, const FillingSize& size = {});

}  // namespace qmorph::cleanup
