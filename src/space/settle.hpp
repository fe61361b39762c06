// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "qmorph/options.hpp"
#include "space/mesh_on_surface.hpp"

namespace qmorph::space {

/// Moves nodes over the surface, so that the centres of quads come nearer to it, where that is worth what it costs in
/// shape. Away from the edges of the surface's triangles nodes lie below what those stand for, and each node that goes
/// towards an edge takes the centres around with it. Where centres are near the surface nothing moves. Cost: linear.
void settle(MeshOnSurface& mesh, const SmoothingOptions& options);

}  // namespace qmorph::space
