// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/irregular_nodes.hpp"

namespace qmorph::chart {

std::vector<char> irregular_nodes(const SurfaceMesh& mesh, const std::vector<Edge>& creases) {
  std::vector<Index> faces(mesh.points.size(), 0);
  std::vector<char> result(mesh.points.size(), 0);
  for (const Face& face : mesh.faces)
    for (Index i = 0; i < degree(face); ++i) ++faces[face[i]];
  for (Index v = 0; v < faces.size(); ++v) result[v] = faces[v] != 0 && faces[v] != 4 && !mesh.fixed[v];
  for (Index side = 0; side < mesh.open.size(); ++side) {
    if (!mesh.open[side]) continue;
    const Face& face = mesh.faces[side / 4];
    result[face[side % 4]] = result[face[next_corner(face, side % 4)]] = 0;
  }
  for (const auto& [a, b] : creases) result[a] = result[b] = 0;
  return result;
}

}  // namespace qmorph::chart
