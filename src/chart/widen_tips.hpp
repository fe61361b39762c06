// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "chart/interfaces.hpp"
#include "chart/surface_mesh.hpp"

namespace qmorph::chart {

/// The mesh with a third quad at each tip that two quads surround; none if there is no such tip. In a plane there is
/// nothing against two of them; at the tip of a cone both are bent by as much as the cone is. One of the edges at the
/// tip is opened as far as the second node along it. `creases`: edges of the mesh, lower node first, sorted; they stay.
/// The new nodes lie on the surface. Cost: linear.
std::optional<SurfaceMesh> with_wider_tips(const SurfaceMesh& mesh, const std::vector<Edge>& creases,
                                           const space::Background& surface);

}  // namespace qmorph::chart
