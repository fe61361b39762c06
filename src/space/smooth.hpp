// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "qmorph/options.hpp"
#include "space/mesh_on_surface.hpp"

namespace qmorph::space {

/// Smooths a mesh that was made in a chart by its shapes in space: nodes move down the shape energy of the elements
/// around, and those at poor corners down that of the corners, in the tangent plane, and go back to the surface. No
/// element gets worse than the worst around was, unless it stays good. Cost: linear; after the first pass only nodes
/// near one that moved are visited.
void smooth(MeshOnSurface& mesh, const SmoothingOptions& options);

/// The same, but that it begins with these nodes and their neighbours alone.
void smooth_near(MeshOnSurface& mesh, const SmoothingOptions& options, std::span<const Index> nodes);

}  // namespace qmorph::space
