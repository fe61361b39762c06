// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Smoothing and repair: nodes move, the topology stays.

#include <functional>
#include <span>

#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::smoothing {

class Star;

/// Smooths every node that is free. No element that is valid becomes invalid; elements that are not are untangled where
/// moving nodes can do it. Later passes visit only nodes near one that moved. Cost: linear, plus what the budget allows
/// for nodes of poor elements, which are optimised one by one, the worst first if the budget does not last for all.
void smooth(kernel::Mesh& mesh, const SmoothingOptions& options, const kernel::Budget& budget = {});

/// The same for a few nodes and `rings` rings of neighbours around them. Returns false if an element near them is
/// not valid in the end; what has been moved by then has to be rolled back by the caller. Before each pass it asks
/// `goes_on(pass)`, if there is one, and gives up (false) if not; before pass 0 elements may be turned over.
bool smooth_near(kernel::Mesh& mesh, const SmoothingOptions& options, std::span<const Index> nodes, int rings,
                 const std::function<bool(int)>& goes_on = {});

/// One Newton step of the shape energy at v, shortened until the energy falls. Returns how far v moved,
/// relative to one of its edges; 0 if v is fixed.
double relax_node(kernel::Mesh& mesh, Index v);
/// The same for many nodes; `star` is scratch space.
double relax_node(kernel::Mesh& mesh, Index v, Star& star);

}  // namespace qmorph::smoothing
