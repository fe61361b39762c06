// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "chart/chart.hpp"

namespace qmorph::chart {

/// What a piece of a mesh has become.
struct Reworked {
  const Piece* piece = nullptr;
  kernel::Mesh mesh;
  Lifted lifted;
};

/// The mesh with pieces, none of which has a face of another, replaced by what they have become. Vertices keep their
/// numbers; some are used by no face any more.
SurfaceMesh replace(const SurfaceMesh& mesh, const std::vector<Reworked>& pieces);

/// Where a quad of a piece and one beyond it have each closed the same three edges of its boundary, they lie back to back
/// and have the same nodes. Both go, if none of the three edges is a crease (nodes, lower first; sorted): what is around
/// closes without them. Some vertices are used by no face any more.
void drop_flat_pairs(SurfaceMesh& mesh, const std::vector<std::pair<Index, Index>>& creases);

/// Whether an edge of the piece has more than two faces: one inside, and another that was made beyond it.
bool has_double_edge(const Piece& piece);

/// Where the piece ends on both sides of a line, one node has two points there. An element may have got both, or two
/// edges have become one.
bool folds_onto_itself(const kernel::Mesh& mesh, const Piece& piece);

}  // namespace qmorph::chart
