// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Elements into the current model. Their nodes are in it, and the entities have no elements yet.

#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// One call of Gmsh for each entity. Each makes Gmsh look at all nodes of the model again.
void add_elements_by_calls(const std::vector<const EntityMesh*>& entities);

/// A file that is merged: no call takes several entities, but a file has all of them.
/// \throws InputError if there is no temporary file
void add_elements_by_file(const std::vector<const EntityMesh*>& entities);

/// The quicker of the two. The model is the same.
/// \param nodes in the whole model
void add_elements(const std::vector<const EntityMesh*>& entities, std::size_t nodes);

}  // namespace qmorph::adapter
