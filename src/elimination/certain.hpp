// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Eliminating two triangles without any search for positions: what is done when nothing better was found.

#include <span>
#include <vector>

#include "kernel/mesh.hpp"

namespace qmorph::elimination {

/// The triangle behind path[0] meets the one behind the last edge of `path`, a chain of faces that is crossed edge by
/// edge, quads between. Every quad on the way is cut in two, so that the chain becomes pairs of triangles, and each
/// pair a quad if it is convex, else five quads with four nodes inside, whose places are known: any two triangles that
/// share a side can be divided so. Appends the nodes of the new elements to `nodes`. False, perhaps half-way, where two
/// faces share more than one edge or where corners are too small for numbers: to be called in a transaction.
bool pair_along(kernel::Mesh& mesh, std::span<const Index> path, std::vector<Index>& nodes);

}  // namespace qmorph::elimination
