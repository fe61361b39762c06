// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Quads where no chart was found.

#include "chart/interfaces.hpp"
#include "qmorph/options.hpp"

namespace qmorph::chart {

/// Pairs triangles as they are, by their shapes in space, best first. Two that are left meet along the shortest chain
/// of faces between them: the chain alone can be laid flat where the surface around it cannot. No pair and no chain
/// lies across one of the walls. Returns the work that chains have cost (`kernel::Mesh::work()`); when that is more than
/// is `allowed`, triangles may be left that could meet.
std::size_t pair_up(SurfaceMesh& mesh, const std::vector<Edge>& walls, const space::Background& background,
                    const SmoothingOptions& smoothing, double allowed);

}  // namespace qmorph::chart
