// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Raises the worst corners of a neighbourhood together, where the shape energy has done what it can.

#include <span>

#include "kernel/budget.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"
#include "smoothing/node_energy.hpp"

namespace qmorph::smoothing {

/// Moves the nodes near corners whose sine is under `options.good_quality` down the sum of sine^-2p over the corners
/// around: for a large p that is nearly the worst one alone, but smooth, so that Newton's steps work where a search on
/// the minimum sticks in a corner of the function. No corner falls under what the worst one around was.
void raise_worst_corners(kernel::Mesh& mesh, const SmoothingOptions& options, const kernel::Budget& budget = {});

/// The sum for elements around a node, if that is at p; with derivatives if `derive`.
Energy corner_energy(std::span<const StarElement> elements, const Vec2& p, bool derive);

}  // namespace qmorph::smoothing
