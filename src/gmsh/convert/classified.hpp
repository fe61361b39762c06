// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// The model's mesh with every node owned by the lowest entity that uses it.
struct ClassifiedMesh {
  ModelMesh mesh;
  NodeUse use;
};

/// Reads it. Nodes in entities that do not use them are classified again, with a warning.
/// \throws InputError if the mesh contradicts itself, or has ghost cells
ClassifiedMesh read_classified_mesh(std::vector<std::string>& warnings);

}  // namespace qmorph::adapter
