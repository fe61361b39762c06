// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Surfaces and curves that a caller names by their tags.

#include <cstdint>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// Indices into ModelMesh::entities, in their order, of the entities of this dimension with these tags. In a
/// partitioned mesh the elements of an entity belong to its parts, which have tags of their own: these are chosen, too.
/// \param dim 1 or 2
/// \throws UsageError if the model does not have one of the tags
std::vector<std::uint32_t> find_chosen(const ModelMesh& mesh, int dim, const std::vector<int>& tags);

/// The same for surfaces, and all of them if there are no tags.
std::vector<std::uint32_t> choose_surfaces(const ModelMesh& mesh, const std::vector<int>& tags);

}  // namespace qmorph::adapter
