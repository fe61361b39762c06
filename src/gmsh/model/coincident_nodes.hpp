// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Nodes of surfaces that lie where other nodes lie: elements on the one side know nothing of those on the other.

#include <cstddef>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

struct CoincidentNodes {
  std::size_t count = 0;  ///< nodes that lie on one that comes before them
  Index first = kNone;    ///< row of one of them
};

/// Cost: linear.
CoincidentNodes find_coincident_nodes(const ModelMesh& mesh, const NodeUse& use);

}  // namespace qmorph::adapter
