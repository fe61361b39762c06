// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Hill climbing on what a whole region is worth, where the usual cleanup has come to its end.

#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cleanup {

/// Takes the quads with a sharp or flat corner, the worst first, and tries the changes of operations.hpp around each,
/// one alone, then two together; keeps, after a guarded relaxation, whatever raises the mean of shapes over all
/// elements and lifts those under 0.5 (weighed together, so that neither is had for much of the other). The size of the
/// elements counts for nothing. Boundary, fixed nodes and parity stay. Returns the number of changes.
/// Cost: the budget; that is for small regions, where one change more or less is much of the result.
std::size_t raise_worth(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget);

/// Where the worst corner is still poor (a sine under 0.5): iterated local search [Lourenco03]. A few changes at random
/// around the worst quad, raise_worth() around them, and back unless the worst corner is better and the whole worth
/// more. The same mesh has always the same result. Parity and boundary stay. Returns how many times it was lifted.
/// Cost: the budget, all of it if a corner stays poor.
std::size_t lift_worst(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget);

}  // namespace qmorph::cleanup
