// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>

#include "kernel/mesh.hpp"

namespace qmorph::smoothing {

/// Moves v to where the smallest corner area (cross product of a corner's edges) around it is largest. Each
/// such area is a linear function of v, so this is a linear program with one solution, and if any position
/// of v makes all corners convex that depend on it, the result does. [FreitagPlassmann00]
/// Returns false if v is fixed or on the boundary, or if nothing better was found.
bool untangle_node(kernel::Mesh& mesh, Index v);

/// Moves v to raise the smallest corner sine around it (its neighbours' corners included); compass search.
/// Never makes an element invalid. Returns true if v moved. Adds the elements that it looked at to `work`.
bool raise_smallest_sine(kernel::Mesh& mesh, Index v, std::size_t& work);

/// A face around one of the `free_nodes` has a corner that is not convex and whose three nodes are all elsewhere: no
/// movement of `free_nodes` makes it valid. `free_nodes` is sorted.
bool has_immovable_fault(const kernel::Mesh& mesh, std::span<const Index> free_nodes);

}  // namespace qmorph::smoothing
