// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Quads that take part: a patch of triangles and quads becomes regions of triangles, and those become meshes of both.

#include "engine/regions.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph {

/// The patch with each quad cut into two triangles, along the diagonal that is a constraint, else along that which
/// leaves the larger of the two smaller areas.
/// The halves come after the triangles that are there, two and two; their common side is the last of the first and the
/// first of the second.
Patch cut_quads(const Patch& patch);

/// The mesh of a region of `cut_quads(patch)`, in which the halves are quads again, good or bad. `triangles` is how
/// many triangles the patch had.
kernel::Mesh join_halves(const Region& region, std::size_t triangles);

/// Sets points and triangles of a region to those of its mesh; quads, convex all of them, are cut in two.
void take_triangles(const kernel::Mesh& mesh, Region& region);

/// Makes every quad valid: nodes with two neighbours are removed, bad elements are untangled where moving their nodes
/// can do it, quads that stay bad are cut into two triangles. Triangles without area may be left.
/// \throws SurfaceError for an element that is turned over all the same.
void mend_quads(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const Plane& plane);

}  // namespace qmorph
