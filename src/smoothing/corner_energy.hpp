#pragma once
/// Raises the worst corners of a neighbourhood together, where the shape energy has done what it can.

#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::smoothing {

/// Moves the nodes near corners whose sine is under `options.good_quality` down the sum of sine^-2p over the corners around:
/// for a large p that is nearly the worst one alone, but smooth, so that Newton's steps work where a search on the
/// minimum sticks in a corner of the function. No corner falls under what the worst one around was.
void raise_worst_corners(kernel::Mesh& mesh, const SmoothingOptions& options);

}  // namespace qmorph::smoothing
