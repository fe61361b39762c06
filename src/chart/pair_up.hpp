// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Quads where no chart was found.

#include "chart/interfaces.hpp"
#include "qmorph/options.hpp"

namespace qmorph::chart {

/// Pairs triangles as they are, by their shapes in space, best first. Two that are left meet along the shortest chain
/// of faces between them: the chain alone can be laid flat where the surface around it cannot. No pair and no chain
/// lies across one of the walls. Searches that find nothing end at a number of looks in proportion to the mesh, and
/// triangles may be left. Returns the work, as kernel::Mesh::work() counts it.
std::size_t pair_up(SurfaceMesh& mesh, const std::vector<Edge>& walls, const space::Background& background,
                    const SmoothingOptions& smoothing);

}  // namespace qmorph::chart
