// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Topological cleanup: fewer irregular nodes, better corners.

#include <vector>

#include "cleanup/replace_cavities.hpp"
#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cleanup {

/// Changes the connectivity where valences get better, each change in a transaction that is kept only if the
/// elements around are valid and good enough after a guarded relaxation. Boundary, fixed nodes and parity stay.
/// Returns the number of changes. Cost: linear.
std::size_t clean_up(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget = {},
                     const CavityLimits& limits = {});

/// The same, but that it begins with the irregular nodes among these alone; bands are left as they are.
std::size_t clean_up_near(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const std::vector<Index>& nodes,
                          const kernel::Budget& budget = {});

}  // namespace qmorph::cleanup
