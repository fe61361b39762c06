// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A region whose quads are a grid between four corners: its nodes have places of their own.

#include "kernel/mesh.hpp"

namespace qmorph::smoothing {

/// If the mesh is a grid of quads (four corners, all other nodes regular), moves its nodes to those of the Coons patch
/// of its sides [Coons67], where smoothing by passes over the nodes would only arrive in the limit. Kept if no element
/// gets invalid and neither the smallest nor the mean scaled Jacobian falls. Returns whether it was kept. Cost: linear.
bool snap_to_grid(kernel::Mesh& mesh);

}  // namespace qmorph::smoothing
