// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// Gives entities of the current model their elements. Their nodes are in the model, and they have no elements yet.
void add_elements(const std::vector<const EntityMesh*>& entities);

}  // namespace qmorph::adapter
