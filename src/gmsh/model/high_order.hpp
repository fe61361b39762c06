// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Elements of second and higher order. The engine sees their corners; what lies between is kept where the edge was
/// there before, and made where it is new. Surfaces are planar, so that straight is right for what is new.

#include <functional>
#include <string>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/patches.hpp"

namespace qmorph::adapter {

/// Order of a surface's elements.
/// \throws SurfaceError if it has elements that are neither triangles nor quads, or of several orders
int order_of(const EntityMesh& surface);

/// Makes the elements of a converted surface of the order that it had before: quads with inner nodes (9 for order 2)
/// unless the surface had quads without (8), or `incomplete`. Edges of the input whose ends have not moved keep their
/// nodes, quads of the input keep all of theirs.
/// \param surface linear, with all nodes that it owns; gets more
/// \param next_tag for new nodes
void raise_order(const ModelMesh& mesh, const EntityMesh& before, bool incomplete, EntityMesh& surface,
                 const std::function<std::size_t()>& next_tag);

/// Where a curved edge of the input turns a corner of the result over, or makes it flat: "at (1, 2, 0)", or empty.
std::string find_bent_corner(const ModelMesh& mesh, const EntityMesh& before, const SurfacePart& part,
                             const QuadMesh& result);

/// The same for a surface of a model as it is; an element's own corners say which way is up.
std::string find_bent_corner(const ModelMesh& mesh, const EntityMesh& surface);

}  // namespace qmorph::adapter
