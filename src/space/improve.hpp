// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "chart/curved_region.hpp"
#include "chart/interfaces.hpp"
#include "qmorph/options.hpp"

namespace qmorph::space {

/// Faces of a mesh that is as good as it gets, but where the surface itself is folded.
struct Faults {
  std::vector<Index> turned;    ///< they stay turned over, the worst first
  std::vector<Index> doubtful;  ///< valid, but it is nearly chance that they are
};

/// A mesh that was made in charts of a region, by what it is in space: smoothed, its poor elements raised, those that
/// are turned over mended. Boundary, fixed nodes and edges on creases stay. `creases` are edges of the mesh, lower node
/// first, sorted.
Faults improve(chart::SurfaceMesh& mesh, const std::vector<chart::Edge>& creases, const chart::CurvedRegion& region,
               const SmoothingOptions& options);

}  // namespace qmorph::space
