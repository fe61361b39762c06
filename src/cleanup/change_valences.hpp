// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Cleanup by score: the local changes of operations.hpp.

#include <vector>

#include "cleanup/refused.hpp"
#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cleanup {

/// Changes the connectivity where the sum of (valence - ideal)^2 falls, each change in a transaction that is
/// kept only if the elements around are valid and good enough after a guarded relaxation. Boundary, fixed nodes
/// and parity stay. Returns the number of changes. Cost: linear.
/// Changes are noted in `refused`.
std::size_t change_valences(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget = {},
                            Refused* refused = nullptr);

/// The same, but that it begins with these nodes alone.
std::size_t change_valences_near(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const std::vector<Index>& nodes,
                                 const kernel::Budget& budget = {});

}  // namespace qmorph::cleanup
