// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Poor quads with all that is around them replaced, by an exact search.

#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cleanup {

/// Whether a quad has a corner under a sine of 0.45.
bool has_poor_quads(const kernel::Mesh& mesh);

/// Takes those quads, the worst first, and tries all ways to fill what is around each, with one node more inside at
/// most (`find_quadrangulations()`), those first whose valences are best; keeps, after a guarded relaxation, one that
/// makes the poor quads clearly better, which some irregular nodes are worth. Boundary, fixed nodes and parity stay.
/// Returns how many times it has replaced something. Cost: some 100 000 of work for each poor quad, and the budget.
std::size_t refill_around_poor(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget);

}  // namespace qmorph::cleanup
