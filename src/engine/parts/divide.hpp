// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Where a large region of triangles is cut, so that its parts can be made into quads side by side.

#include <vector>

#include "kernel/mesh.hpp"

namespace qmorph {

/// A mesh of triangles in parts. The edges between two parts are interfaces.
struct Division {
  std::vector<Index> part;  ///< of each face; kNone for a dead one
  Index parts = 1;
  std::vector<Index> interface;  ///< nodes on interfaces, ascending
  bool is_interface(const kernel::Mesh& mesh, Index h) const {
    const Index f = mesh.face(h), g = mesh.face(kernel::Mesh::twin(h));
    return f != kNone && g != kNone && part[f] != part[g];
  }
};

/// Cuts the mesh into parts of about `triangles` triangles: along lines that are short and end squarely on the
/// boundary. The edges along a line are straightened, for which free nodes near it move (no triangle becomes bad), and
/// some are split, so that one part at most has an odd number of sides. A mesh of less than 1.5 times `triangles` is
/// one part.
/// Cost: linear.
Division divide(kernel::Mesh& mesh, std::size_t triangles);

}  // namespace qmorph
