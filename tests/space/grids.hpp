// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Quads over the cells of grids of triangles.

#include <vector>

#include "chart/curved_region.hpp"
#include "space/surfaces.hpp"

namespace qmorph::test {

/// The quads of a grid of the same cells, on the nodes of its triangles.
inline QuadMesh quads_of(const GridSurface& grid, const Patch& patch) {
  QuadMesh mesh;
  mesh.points = patch.points;
  const Index columns = grid.across + !grid.closed_across, rows = grid.along + !grid.closed_along;
  for (Index j = 0; j < grid.along; ++j)
    for (Index i = 0; i < grid.across; ++i) {
      const Index right = (i + 1) % columns, up = (j + 1) % rows;
      mesh.quads.push_back({j * columns + i, j * columns + right, up * columns + right, up * columns + i});
    }
  for (Index i = 0; i < mesh.points.size(); ++i) mesh.source.push_back(i);
  return mesh;
}

/// The same as a mesh on the only region of the patch, whose triangles lie two by two in the cells. `vertex` gets the
/// region's number of each node of the patch.
inline chart::SurfaceMesh quads_on(const chart::CurvedRegion& region, const QuadMesh& quads,
                                   std::vector<Index>& vertex) {
  vertex.assign(quads.points.size(), kNone);
  for (Index v = 0; v < region.region.node.size(); ++v) vertex[region.region.node[v]] = v;
  chart::SurfaceMesh mesh = region.start();
  std::vector<Index> triangle_of(region.region.row.size());
  for (Index t = 0; t < region.region.row.size(); ++t) triangle_of[region.region.row[t]] = t;
  mesh.faces.clear(), mesh.open.clear(), mesh.near.clear();
  for (Index q = 0; q < quads.quads.size(); ++q) {
    const auto& n = quads.quads[q];
    mesh.faces.push_back({vertex[n[0]], vertex[n[1]], vertex[n[2]], vertex[n[3]]});
    mesh.near.push_back(triangle_of[2 * q]);
  }
  mesh.open.assign(4 * mesh.faces.size(), false);
  return mesh;
}

}  // namespace qmorph::test
