// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "gmsh/even/even_links.hpp"
#include "gmsh/even/split_edges.hpp"
#include "gmsh/model/chosen.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "kernel/sort_unique.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph {
namespace {

using namespace adapter;

struct ReadMesh {
  ModelMesh mesh;
  NodeUse use;
};

/// With every node owned by the lowest entity that uses it, or else clearing a surface would take nodes from others.
ReadMesh read_classified() {
  ReadMesh read;
  read.mesh = read_model_mesh();
  read.use = find_node_use(read.mesh);
  if (!is_misclassified(read.mesh, read.use)) return read;
  const auto pinned_tags = [&] {
    std::set<std::size_t> tags;
    for (Index row = 0; row < read.mesh.tags.size(); ++row)
      if (read.use.pinned[row]) tags.insert(read.mesh.tags[row]);
    return tags;
  };
  const std::set<std::size_t> before = pinned_tags();
  const StageLog log = run_logged([] { ::gmsh::model::mesh::reclassifyNodes(); });
  if (!log.errors.empty()) throw InputError("Gmsh cannot classify the nodes: " + first_errors(log));
  read.mesh = read_model_mesh();
  read.use = find_node_use(read.mesh);
  if (pinned_tags() != before)
    throw InputError(
        "the file has nodes in entities that do not use them, and curves without line elements; save it with "
        "Gmsh first (Mesh.SaveAll = 1)");
  return read;
}

/// Such a surface stays as it is: tetrahedra stand on its triangles.
bool bounds_volume(const ModelMesh& mesh, const NodeUse& use, const EntityMesh& surface) {
  for (const ElementBlock& block : surface.blocks)
    for (std::size_t i = 0; i + block.nodes_per_element <= block.nodes.size(); i += block.nodes_per_element)
      if (std::all_of(block.nodes.begin() + std::ptrdiff_t(i), block.nodes.begin() + std::ptrdiff_t(i) + 3,
                      [&](std::size_t tag) {
                        const Index row = mesh.rows.find(tag);
                        return row != kNone && use.volume[row] != kNobody;
                      }))
        return true;
  return false;
}

std::vector<std::uint32_t> find_surfaces(const ModelMesh& mesh, const NodeUse& use, const std::vector<int>& wanted) {
  std::vector<std::uint32_t> found = choose_surfaces(mesh, wanted);
  std::erase_if(found, [&](std::uint32_t e) { return bounds_volume(mesh, use, mesh.entities[e]); });
  return found;
}

/// Tags of the curves to keep, in a partitioned mesh of their parts, too.
std::set<int> check_curves(const ModelMesh& mesh, const std::vector<int>& keep_curves) {
  std::set<int> curves(keep_curves.begin(), keep_curves.end());
  for (std::uint32_t e : find_chosen(mesh, 1, keep_curves)) curves.insert(mesh.entities[e].tag);
  return curves;
}

}  // namespace

EvenReport session::make_even(const std::vector<int>& surfaces, const std::vector<int>& keep_curves) {
  const QuietErrors quiet;
  ReadMesh read = read_classified();
  const RegionGraph graph = find_region_graph(read.mesh, read.use, find_surfaces(read.mesh, read.use, surfaces),
                                              check_curves(read.mesh, keep_curves));
  EvenReport report;
  report.odd_regions = std::size_t(std::count(graph.odd.begin(), graph.odd.end(), true));
  const parity::Plan plan = parity::plan_splits(graph.odd, graph.links);
  for (Index region : plan.odd_left) report.odd_surfaces.push_back(read.mesh.entities[graph.surface[region]].tag);
  sort_unique(report.odd_surfaces);
  if (plan.splits.empty()) return report;

  EdgeSplitter splitter(read.mesh);
  for (Index link : plan.splits)
    for (const auto& [a, b] : graph.edges[link]) splitter.plan(a, b);
  report.splits = splitter.run();
  splitter.put_back();
  return report;
}

}  // namespace qmorph
