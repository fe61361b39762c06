// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::smoothing {

/// The global smoothing of the thesis (2.2.6, 3.7): constrained Laplacian moves, and optimisation of the nodes whose
/// elements are still worse than OBSTOL after two of them. Passes over `nodes`, later ones over those near one that
/// moved, MAXITER at most. Elements that are invalid at the start are untangled first, which the thesis leaves open.
void smooth_by_thesis(kernel::Mesh& mesh, const ThesisSmoothing& options, const std::vector<Index>& nodes);

}  // namespace qmorph::smoothing
