// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "chart/curved_region.hpp"
#include "chart/interfaces.hpp"
#include "qmorph/options.hpp"

namespace qmorph::space {

/// Faces that remain bad when nothing helps any more, apart from those where the surface itself is folded.
struct Faults {
  std::vector<Index> turned;    ///< they stay turned over, the worst first
  std::vector<Index> doubtful;  ///< valid, but it is nearly chance that they are, or by the surface's normals only
  std::size_t work = 0;         ///< that it took, above all to look closely; as kernel::Mesh::work() counts it
};

/// Improves a mesh that was made in charts of a region, judged in space: it is smoothed, its poor elements are raised,
/// and those that are turned over are mended. Boundary, fixed nodes and edges on creases stay. `creases` are edges of
/// the mesh, lower node first, sorted. `stretched` marks triangles of the region, and may be empty: nodes there were
/// smoothed for what quads are to be there, and move only where an element is poor.
Faults improve(chart::SurfaceMesh& mesh, const std::vector<chart::Edge>& creases, const chart::CurvedRegion& region,
               const std::vector<char>& stretched, const SmoothingOptions& options);

/// The faces that are turned over as the mesh is, apart from those where the surface itself is folded.
std::vector<Index> find_turned(chart::SurfaceMesh mesh, const std::vector<chart::Edge>& creases,
                               const chart::CurvedRegion& region, const std::vector<char>& stretched);

/// Whether a face is turned over against the region's surface, also where that is folded itself.
bool has_turned(chart::SurfaceMesh mesh, const chart::CurvedRegion& region);

}  // namespace qmorph::space
