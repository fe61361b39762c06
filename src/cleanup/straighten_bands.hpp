// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Bands of one row between two boundaries (the air gap of a machine, a coating): nothing there can move, so only
/// connectivity can take the skew out.

#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cleanup {

/// Finds the bands that are one row wide, or two for a few elements, and gives them the rows of band_plan.hpp where
/// that makes the elements better on average. Returns the number of changes. Cost: linear.
std::size_t straighten_bands(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget = {});

}  // namespace qmorph::cleanup
