// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "chart/curved_region.hpp"
#include "chart/interfaces.hpp"
#include "qmorph/options.hpp"

namespace qmorph::space {

/// A mesh that was made in charts of a region, by what it is in space: smoothed, its poor elements raised, those that are turned
/// over mended. Boundary, fixed nodes and edges on creases stay. `creases` are edges of the mesh, lower node first, sorted.
/// \throws SurfaceError if an element stays turned over although the surface is not folded there
chart::SurfaceMesh improve(chart::SurfaceMesh mesh, const std::vector<chart::Edge>& creases,
                           const chart::CurvedRegion& region, const SmoothingOptions& options);

}  // namespace qmorph::space
