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

/// The same without the pieces in which an edge from rim to rim joins two nodes that another edge joins outside: they
/// stay as they are. Cost: linear.
SurfaceMesh replace_where_simple(const SurfaceMesh& mesh, std::vector<Reworked> pieces);

/// Where the piece ends on both sides of a line, one node has two points there. An element may have got both, or two
/// edges have become one.
bool folds_onto_itself(const kernel::Mesh& mesh, const Piece& piece);

}  // namespace qmorph::chart
