// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Regions with four sides as grids.

#include <optional>

#include "chart/curved_region.hpp"

namespace qmorph::chart {

/// How long quads are to be, if there are about as many as the triangles ask for: as these there, or as it comes.
enum class GridSizes { as_triangles, any };

/// A region without holes that has four corners, and as many edges on opposite sides, as a grid: where its triangles,
/// laid over a rectangle, have the grid's nodes. Nothing if it is no such region, or sizes are other ones. Elements may
/// be turned over where the surface is rough. Cost: one sparse factorisation, near linear.
std::optional<SurfaceMesh> lay_grid(const CurvedRegion& region, GridSizes sizes = GridSizes::as_triangles);

}  // namespace qmorph::chart
