// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "kernel/mesh.hpp"

namespace qmorph {

/// Whether a grid of quads fits into the mesh: its outline is one loop with four corners, straight or gently bent
/// between them, opposite sides have as many edges as each other, and no node inside is fixed.
bool has_grid_outline(const kernel::Mesh& mesh);

}  // namespace qmorph
