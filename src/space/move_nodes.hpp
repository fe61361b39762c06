// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/patch.hpp"
#include "space/result.hpp"

namespace qmorph::space {

/// Nodes of a result that its makers have put on the input's triangles, and that may leave them for the geometry that
/// these stand for: those inside that are not where a node of the input was. `Result::foot` says where they are.
/// Ascending.
QMORPH_API std::vector<Index> movable_nodes(const Result& result, const Patch& before);

/// Where a node is to go.
struct Move {
  Index node = kNone;
  Eigen::Vector3d to;
};

/// Moves nodes of the mesh that `result` is of, but those of elements that would be turned over, or get a scaled
/// Jacobian below 0.3 and clearly less than they had.
/// \return the nodes that stay where they are, ascending
/// Cost: linear.
QMORPH_API std::vector<Index> move_nodes(const Result& result, std::span<const Move> moves, QuadMesh& mesh);

}  // namespace qmorph::space
