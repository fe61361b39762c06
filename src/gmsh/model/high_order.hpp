// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Elements of second and higher order. The engine sees their corners; what lies between is kept where the side was
/// there before, and made where it is new.

#include <functional>
#include <string>
#include <vector>

#include "gmsh/model/curved_elements.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/patches.hpp"

namespace qmorph::adapter {

/// Order of a surface's elements.
/// \throws SurfaceError if it has elements that are neither triangles nor quads, or of several orders
int order_of(const EntityMesh& surface);

/// The elements of a surface as it is, triangles first. Its own nodes may move. Points are numbered as they come.
CurvedElements read_curved_elements(const ModelMesh& mesh, const EntityMesh& surface);

/// The elements of a part's result, triangles first, of the order that the surface had before: quads with inner nodes
/// (9 for order 2) unless there were quads without (8). Sides of the input whose ends have not moved keep their nodes,
/// quads of the input all of theirs; what is new is straight.
/// \pre of a higher order than 1
/// \throws SurfaceError if Gmsh has no elements of that order
CurvedElements curve_result(const ModelMesh& mesh, const EntityMesh& before, const SurfacePart& part,
                            const QuadMesh& result);

/// Makes the elements of a converted surface what `parts` say.
/// \param part_tags of the nodes of each part
/// \param surface linear, with all nodes that it owns; gets more
/// \param next_tag for new nodes
void raise_order(const ModelMesh& mesh, const EntityMesh& before, std::vector<CurvedElements> parts,
                 const std::vector<std::vector<std::size_t>>& part_tags, EntityMesh& surface,
                 const std::function<std::size_t()>& next_tag);

/// Where a curved side turns an element over, or makes it flat: "at (1, 2, 0)", or empty.
std::string find_bent(const CurvedElements& elements);

}  // namespace qmorph::adapter
