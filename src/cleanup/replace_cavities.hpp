// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Irregular nodes that cancel each other over a distance: a disc of quads around them is replaced as a whole.

#include <vector>

#include "cleanup/filling_choice.hpp"
#include "cleanup/refused.hpp"
#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cleanup {

/// How far a search for a filling goes.
struct CavityLimits {
  std::size_t most_quads = 200;
  int most_nodes = 12;  ///< irregular ones that a cavity grows to
  int most_tries = 3;   ///< fillings of one cavity
  int iterations = 6;   ///< of the smoothing by which one is judged
  FillingSize size;
};

/// Grows a disc of quads from each irregular node to others and replaces it by a filling (filling.hpp) whose valences
/// score better, in a transaction that is kept only if the elements around are good enough afterwards. The outline
/// stays, so do boundary, fixed nodes and parity. Returns the number of replacements. Cost: linear.
/// Nodes for which `refused` holds are passed over; what is found and what is not is noted there.
std::size_t replace_cavities(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget = {},
                             const CavityLimits& limits = {}, Refused* refused = nullptr);

/// The same, but that it begins with these nodes alone, and never replaces the region as a whole.
std::size_t replace_cavities_near(kernel::Mesh& mesh, const SmoothingOptions& smoothing,
                                  const std::vector<Index>& nodes, const kernel::Budget& budget = {},
                                  const CavityLimits& limits = {});

/// Cavities at quads of poor shape get fillings that score no worse and raise the worst corner; the worst quads come
/// first where the budget does not last for all.
std::size_t replace_poor_cavities(kernel::Mesh& mesh, const SmoothingOptions& smoothing,
                                  const kernel::Budget& budget = {});

}  // namespace qmorph::cleanup
