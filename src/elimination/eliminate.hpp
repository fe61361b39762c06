// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Triangle elimination: what makes the parity of triangles (I5 in src/README.md) a guarantee.

#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::elimination {

/// What may be done so that two triangles meet.
enum class Means {
  moving,   ///< nodes may move, as far as shapes allow it with reasonable effort
  cutting,  ///< where that fails, the quads between them are cut up: always possible, but the elements are poor
};

/// Pairs the triangles that are left, best shape first, then passes triangles along the shortest chain of
/// elements to one another until at most one is left. Valid elements stay valid. Returns the number of
/// triangles left: with `cutting` 0 or 1 unless corners are too small for numbers.
std::size_t eliminate_triangles(kernel::Mesh& mesh, const SmoothingOptions& smoothing, Means means = Means::cutting,
                                const kernel::Budget& budget = {});

}  // namespace qmorph::elimination
