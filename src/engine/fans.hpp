// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "kernel/mesh.hpp"

namespace qmorph {

/// Grades the triangles of large fans. Where very many triangles meet at a node (a disc or a strip that was
/// triangulated without nodes inside), there is no room for quads, and work on the node is quadratic in their number.
/// Rings of nodes are put around it: each as far inside as the edges of the ring before are long, with half as many
/// nodes. No node moves, and the boundary stays. A fan is left as it is where that would make triangles much worse.
/// Returns the number of rings. Cost: linear.
std::size_t grade_fans(kernel::Mesh& mesh);

}  // namespace qmorph
