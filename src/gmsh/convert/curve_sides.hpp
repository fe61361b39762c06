// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gmsh/convert/replace.hpp"
#include "gmsh/geometry/landing.hpp"

namespace qmorph::adapter {

/// Gives the elements of a converted surface of higher order their middle nodes: those of the input where a side is the
/// input's, others where the lander takes them, or in the middle where that would fold an element. Nothing for order 1.
/// \param lander may be empty
/// Elements may be folded beside sides of the input that folded triangles, too: `ConvertedSurface::bent` says where.
/// \throws SurfaceError if another element is folded all the same
void curve_sides(const ModelMesh& mesh, const Lander& lander, ConvertedSurface& surface);

}  // namespace qmorph::adapter
