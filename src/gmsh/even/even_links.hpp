// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The regions of a model's surfaces as a graph: which are odd, and which edges of the mesh may be split.

#include <set>
#include <vector>

#include "gmsh/model/model_mesh.hpp"
#include "parity/plan.hpp"

namespace qmorph::adapter {

/// Regions are numbered through all surfaces: triangles of one surface, joined through edges that nothing holds.
struct RegionGraph {
  std::vector<bool> odd;
  std::vector<std::uint32_t> surface;  ///< of a region: index into ModelMesh::entities
  std::vector<parity::Link> links;
  std::vector<std::vector<std::pair<Index, Index>>> edges;  ///< of a link: rows of the ends of each of its edges
};

/// The curve that an edge of a region's boundary lies on although no line element says so: that of a node inside it. An
/// index into ModelMesh::entities, or kNobody.
std::uint32_t curve_under(const ModelMesh& mesh, Index row_a, Index row_b);

/// \param surfaces indices of the surfaces to be converted
/// \param keep_curves tags of curves that get no node
/// Edges that are images of one another (periodic curves) get a node together, and count as often. Nor do edges get a
/// node if an element beside them is not a triangle of these surfaces, if a volume or more than two elements of one
/// surface use them, or if elements of several orders do.
RegionGraph find_region_graph(const ModelMesh& mesh, const NodeUse& use, const std::vector<std::uint32_t>& surfaces,
                              const std::set<int>& keep_curves);

/// Whether regions of the current model are odd, and no node on a curve makes them even: triangles among quads, for
/// example.
/// \param surfaces tags of those to be converted
bool has_enclosed_odd_regions(const std::vector<int>& surfaces);

}  // namespace qmorph::adapter
