// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Elements that are turned over against the surface, or poor, after all smoothing.

#include <vector>

#include "chart/curved_region.hpp"
#include "chart/interfaces.hpp"
#include "qmorph/options.hpp"
#include "space/mesh_on_surface.hpp"

namespace qmorph::space {

/// A face and its smallest sine.
struct PoorFace {
  double sine;
  Index face;
  bool is_straight;  ///< in a corner, by the surface's normals
};

/// Faces whose smallest corner sine is below `sine`, worst first; with 0 those that are not valid.
std::vector<PoorFace> find_poor(const MeshOnSurface& mesh, double sine);

/// Moves the nodes of faces below `options.target_quality` one at a time to where the smallest sine around is largest,
/// by compass search in the tangent plane. Cost: a number of looks in proportion to the mesh, at the worst faces first,
/// and of close ones (`MeshOnSurface::exact_sine`) a smaller number.
/// Where triangles are stretched, only nodes of invalid faces move. Returns the nodes that moved.
std::vector<Index> raise_poor(MeshOnSurface& mesh, const SmoothingOptions& options);
/// The same for quads that are bent so much that they are poor by their own normals, and not by the surface's: a solver
/// judges an element by itself. Smoothing would bend some again, so this comes last.
void raise_bent(MeshOnSurface& mesh, const SmoothingOptions& options);

/// Faces that are not valid are taken out with a few rings around, laid flat with the surface under them, and untangled
/// there, by moving nodes first, then by changing what is joined to what. What becomes no better stays as it is.
/// `creases` as MeshOnSurface has them; `surface` is the region's, parted along them. Adds to `work` what it has cost,
/// as kernel::Mesh::work() counts it: no more than in proportion to the mesh, and what is left then is not mended.
chart::SurfaceMesh mend_in_charts(chart::SurfaceMesh mesh, const std::vector<chart::Edge>& creases,
                                  const chart::CurvedRegion& region, const Background& surface,
                                  const SmoothingOptions& options, std::size_t& work);

}  // namespace qmorph::space
