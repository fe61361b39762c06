// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Surfaces at the two ends of a volume that Gmsh extrudes. It does so from the mesh of one of them and looks for the
/// nodes of the other where it expects them, so that the second has to stay the image of the first.

#include <cstdint>
#include <set>
#include <vector>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/periodic_links.hpp"

namespace qmorph::adapter {

/// Links from the one end to the other. Nothing says so in the model; what tells are walls of quads, the same triangles
/// in the same order, and a rigid motion from the nodes of the one to those of the other.
/// \param entities surfaces that are going to be converted, indices into the mesh's
/// \param known links that are there already
std::vector<PeriodicLink> find_extrusions(const ModelMesh& mesh, const std::vector<std::uint32_t>& entities,
                                          const std::vector<PeriodicLink>& known);

/// Surfaces of quads between the ends of extruded volumes: Gmsh finds the nodes of the volumes on them.
std::set<int> find_extruded_walls(const ModelMesh& mesh, const std::vector<PeriodicLink>& extrusions);

}  // namespace qmorph::adapter
