// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Optimisation-based smoothing: steepest descent on the worst element [thesis 2.2.6; after Canann, Tristano, Staten].

#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::smoothing {

/// Moves v along the gradient of the smallest metric around it, as far as no other element becomes the smallest by
/// linear prediction, halving until the smallest metric has risen by TOL. No element that was valid becomes
/// invalid. Returns how far v moved, relative to the mean edge at v; 0 if it is not free or nothing was found.
double optimise_node(kernel::Mesh& mesh, Index v, const ThesisSmoothing& options);

}  // namespace qmorph::smoothing
