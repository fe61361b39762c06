// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The distortion metrics that the thesis smooths by [thesis, eq. 2.1, 2.2 with the factor 4 of 3.7; after Canann,
/// Tristano, Staten].

#include "kernel/mesh.hpp"

namespace qmorph::smoothing {

/// 1 for an equilateral triangle and for a square, 0 for an element without area, negative where it is turned over. A
/// quad is as good as the worst of the four triangles that its diagonals make, less 1 if two of those are turned over,
/// a corner is under 6 degrees or two nodes are nearer than `coincidence` times the longest side; less 2 or 3 if three
/// or four are turned over.
double distortion(const kernel::Mesh& mesh, Index f, double coincidence);

/// The smallest of the faces around v.
double smallest_distortion_around(const kernel::Mesh& mesh, Index v, double coincidence);

}  // namespace qmorph::smoothing
