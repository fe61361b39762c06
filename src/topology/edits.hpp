#pragma once
/// Edits of a quad mesh that several stages use; each is made of the kernel's.

#include "kernel/mesh.hpp"

namespace qmorph::topology {

/// Removes an interior node with two neighbours; its two faces become one. Returns the face.
/// Precondition: valence 2, not on the boundary, not fixed.
Index remove_doublet(kernel::Mesh& mesh, Index v);

/// Removes doublets among `nodes` and, as each removal can make another, among the nodes of the faces that
/// result. Returns how many went.
std::size_t remove_doublets(kernel::Mesh& mesh, std::vector<Index> nodes);

/// Smallest corner sine of the polygon that runs through these nodes, counter-clockwise.
double smallest_sine(const kernel::Mesh& mesh, const std::vector<Index>& nodes);

}  // namespace qmorph::topology
