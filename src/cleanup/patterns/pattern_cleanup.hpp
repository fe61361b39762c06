// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Cleanup as the thesis describes it (2.2.5, 3.6; after Kinney): chevrons, then rounds of connectivity, boundary and
/// shape cleanup, all by the cases of cases.hpp.

#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cleanup {

/// Turns quads with an angle over `options.chevron_angle` into others: by moving the node of the angle, else by joining
/// the quad with a neighbour (fill_3, fill_4). Each change leaves fewer invalid elements, so it ends. Returns
/// the number of changes.
std::size_t eliminate_chevrons(kernel::Mesh& mesh, const CleanupOptions& options, const SmoothingOptions& smoothing,
                               const kernel::Budget& budget = {});

/// The three cleanups of the thesis, each `options.pattern_rounds` times; later rounds look at what changed. A change
/// for the sake of valences is kept if the sum of (valence - ideal)^2 falls and no bad corner comes of it; one for the
/// sake of shape also if the worst corner becomes clearly better. Each returns the number of changes. Cost: linear.
///
/// Tables 1 and 2.
std::size_t clean_up_connectivity(kernel::Mesh& mesh, const CleanupOptions& options, const SmoothingOptions& smoothing,
                                  const kernel::Budget& budget = {});
/// Table 3, triangularly shaped quads, and quads that touch the boundary with one node (diamonds).
std::size_t clean_up_boundary(kernel::Mesh& mesh, const CleanupOptions& options, const SmoothingOptions& smoothing,
                              const kernel::Budget& budget = {});
/// Angles over `options.shape_angle`.
std::size_t clean_up_shape(kernel::Mesh& mesh, const CleanupOptions& options, const SmoothingOptions& smoothing,
                           const kernel::Budget& budget = {});

}  // namespace qmorph::cleanup
