// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>

#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::bands {

/// Rows in the gaps of a region that is no band as a whole: between bodies that nearly touch, say. A row of quads from
/// one piece of the boundary to another, in which a corner is under a sine of 0.45, is laid anew, together with the
/// quads at its ends: where three gaps meet, a single row has to begin with half a quad, and all of it leans; with two
/// rows none does. Keeps, after a guarded relaxation, what makes the poor quads clearly better and none poorer than the
/// worst was. Boundary, fixed nodes and parity stay. Returns how many rows it has laid. Cost: linear.
std::size_t relay_leaning_rows(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget);

}  // namespace qmorph::bands
