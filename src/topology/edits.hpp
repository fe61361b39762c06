// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Edits of a quad mesh that several stages use; each is made of the kernel's.

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/mesh.hpp"

namespace qmorph::topology {

/// Removes an interior node with two neighbours; its two faces become one. Returns the face.
/// Precondition: valence 2, not on the boundary, not fixed; the faces have no other side in common.
Index remove_doublet(kernel::Mesh& mesh, Index v);

/// Removes doublets among `nodes` and, as each removal can make another, among the nodes of the faces that
/// result. In the end `nodes` holds, sorted, those that are left and the nodes of the new faces. A doublet whose faces
/// have a third side in common stays: they would not become one.
void remove_doublets(kernel::Mesh& mesh, std::vector<Index>& nodes);

/// Leaves the live ones of some nodes, sorted, each once.
void keep_live(const kernel::Mesh& mesh, std::vector<Index>& nodes);

/// Shrinks a set of faces and puts a layer of quads around it, so that every node of the set is free to
/// move. Appends the new nodes to `nodes`. False, with nothing changed, if the outline of the
/// set touches itself.
bool pillow(kernel::Mesh& mesh, const std::vector<Index>& faces, std::vector<Index>& nodes);

/// New edges from a to b through new nodes at `points`, in the face that has both on its outline; appends the new nodes
/// to `nodes`. Returns the first half-edge from a on, or kNone if there is no such face, or no points and an edge
/// already.
/// Cost: the steps between a and b along the face, the shorter way.
Index draw_path(kernel::Mesh& mesh, Index a, Index b, const std::vector<Vec2>& points, std::vector<Index>& nodes);

/// `faces` and `rings` rings of faces around them that share a node.
std::vector<Index> grow(const kernel::Mesh& mesh, std::vector<Index> faces, int rings);

/// The faces around some nodes, sorted. Dead nodes have none.
std::vector<Index> faces_around(const kernel::Mesh& mesh, const std::vector<Index>& nodes);

/// A hash of which nodes make these faces, and in which sense, whatever the order of the faces: equal for equal ones,
/// for others nearly always another. It is a sum over faces, so what two sets have in common cancels in the difference.
std::uint64_t connectivity(const kernel::Mesh& mesh, const std::vector<Index>& faces);
/// Of all faces.
std::uint64_t connectivity(const kernel::Mesh& mesh);

/// Mean of the nodes that edges join v with.
Vec2 middle_of_neighbours(const kernel::Mesh& mesh, Index v);

/// Moves each of these nodes there, one after the other, so many times over: a guess of where new nodes are becomes a
/// better one.
void spread(kernel::Mesh& mesh, std::span<const Index> nodes, int sweeps);

/// Nodes of a face, counter-clockwise.
std::vector<Index> nodes_of(const kernel::Mesh& mesh, Index f);

/// Smallest corner sine of all faces.
double smallest_sine(const kernel::Mesh& mesh);

/// Smallest corner sine of the polygon that runs through these nodes, counter-clockwise.
double smallest_sine(const kernel::Mesh& mesh, const std::vector<Index>& nodes);

/// The element's worst corner, with edges a and b: 4 a x b / (a^2 + b^2 + (a - b)^2), 1 in a square. Thesis, eq. 2.1
/// and 2.2.
double worst_corner_shape(const kernel::Mesh& mesh, Index f);

}  // namespace qmorph::topology
