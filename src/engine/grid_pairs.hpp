// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Triangles that are a grid's: each is half of a cell, and where four cells meet, lines go on.

#include <optional>

#include "kernel/mesh.hpp"

namespace qmorph {

/// The cells, if all triangles of the mesh are halves of them, every inner node is a corner of four, and there are
/// enough inner nodes to tell a grid from a few triangles that happen to look like one. No node moves. A grid may lean,
/// be stretched, bend, have holes, and diagonals that run either way: what counts is that the triangle beside another
/// goes on as the other's lattice does. Cost: linear; a mesh that is no grid is left after a few triangles.
std::optional<kernel::Mesh> pair_as_grid(const kernel::Mesh& triangles);

/// Sine of the sharpest corner of a cell that is worth keeping: of one that leans by 50 degrees.
constexpr double kPoorestCell = 0.64;

/// Whether the triangles are a grid's, with no cell that leans more.
bool is_good_grid(const kernel::Mesh& triangles);

/// The same, and no cell is stretched: where its triangles are in a row that looks like a layer's, that is by chance.
bool is_unstretched_grid(const kernel::Mesh& triangles);

}  // namespace qmorph
