// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gives entities of the current model other nodes and elements. Gmsh has no call for that: whatever points to what
/// goes has to go and come back with it.

#include <cstdint>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// What some entities are to have in the place of what they have.
struct Replacement {
  std::uint32_t entity = 0;           ///< index into ModelMesh::entities
  const EntityMesh* fresh = nullptr;  ///< may be that entity itself, changed since the model was read
};

/// Entities that lose and get back their mesh when these get another, themselves among them, ascending: clearing frees
/// nodes even if others still point to them, and an entity can be cleared only together with all that lies on it.
/// \throws InputError if a point or a curve would have to go for the sake of a surface
std::vector<std::uint32_t> find_cleared(const ModelMesh& mesh, const std::vector<std::uint32_t>& changed);

/// \param mesh the model's mesh as it was read; its nodes are classified
/// Periodic links of entities that are cleared are lost. Nothing is lost otherwise.
/// \throws InputError if Gmsh refuses a step. The model must not be used then.
void put_back(const ModelMesh& mesh, const std::vector<Replacement>& replacements);

}  // namespace qmorph::adapter
