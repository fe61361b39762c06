// SPDX-License-Identifier: GPL-2.0-or-later
/// --all-quad where one triangle gets more than one node.

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::test;

TEST_CASE("--all-quad: a triangle whose three sides get a node each is cut along all of them") {
  //       6---3---5      Surface 1 in the middle, three triangles around it on curve 11.
  //        \ / \ /
  //         1---2
  //          \ /
  //           4
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
6
1 0 0 0
2 4 0 0
3 2 3.4 0
4 2 -1 0
5 4.2 2.4 0
6 -0.2 2.4 0
$EndNodes
$Elements
13
1 1 2 10 10 1 2
2 1 2 10 10 2 3
3 1 2 10 10 3 1
4 1 2 11 11 1 4
5 1 2 11 11 4 2
6 1 2 11 11 2 5
7 1 2 11 11 5 3
8 1 2 11 11 3 6
9 1 2 11 11 6 1
10 2 2 1 1 1 2 3
11 2 2 2 2 1 4 2
12 2 2 2 2 2 5 3
13 2 2 2 2 3 6 1
$EndElements
)");
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--all-quad"}).status == 0);
  CHECK(run_qmorph({"--check", directory / "out.msh", "--no-triangles"}).status == 0);
  const Snapshot after = read_snapshot(directory / "out.msh");
  std::map<std::pair<std::size_t, std::size_t>, int> elements_at;  // by edge
  const auto visit_edges = [&](int dim, const auto& visit) {
    for (const adapter::EntityMesh& entity : after.mesh.entities) {
      if (entity.dim != dim) continue;
      for (const adapter::ElementBlock& block : entity.blocks)
        for (std::size_t i = 0; i < block.tags.size(); ++i)
          for (std::size_t k = 0; k < (dim == 1 ? 1 : block.corners); ++k) {
            const std::size_t* nodes = block.nodes.data() + i * block.nodes_per_element;
            visit(entity.tag, std::minmax({nodes[k], nodes[(k + 1) % block.corners]}));
          }
    }
  };
  visit_edges(2, [&](int, const auto& edge) { ++elements_at[edge]; });
  visit_edges(1, [&](int curve, const auto& edge) {
    CHECK(elements_at[edge] == (curve == 10 ? 2 : 1));
    elements_at.erase(edge);
  });
  for (const auto& [edge, count] : elements_at) CHECK(count == 2);
}
