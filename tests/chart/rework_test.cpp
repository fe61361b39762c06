// SPDX-License-Identifier: GPL-2.0-or-later
// Pieces of a mesh that have become something else, and what they leave where they meet.
#include "chart/rework.hpp"

#include <doctest/doctest.h>

#include "chart/fixture.hpp"

using namespace qmorph;
using namespace qmorph::test;
using namespace qmorph::chart;

namespace {

//  7-----------6
//  |           |
//  0-- 1 --2---3     Between 0 and 3 there are two edges, and between these two quads: 0 1 2 3 and 3 2 1 0.
//  |           |
//  4-----------5
SurfaceMesh with_flat_pair() {
  SurfaceMesh mesh;
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {2, 0}, {3, 0}, {0, -1}, {3, -1}, {3, 1}, {0, 1}})
    mesh.add_point(Eigen::Vector3d(x, y, 0), 0);
  mesh.faces = {{0, 3, 6, 7}, {0, 1, 2, 3}, {3, 2, 1, 0}, {4, 5, 3, 0}};
  mesh.near.assign(mesh.faces.size(), 0);
  mesh.open.assign(4 * mesh.faces.size(), false);
  for (const Index side : {1, 2, 3, 4 * 3 + 0, 4 * 3 + 1, 4 * 3 + 3}) mesh.open[side] = true;
  return mesh;
}

}  // namespace

TEST_CASE("rework: two quads back to back go, and what is around them closes") {
  SurfaceMesh mesh = with_flat_pair();
  drop_flat_pairs(mesh, {});
  CHECK(mesh.faces == std::vector<Face>{{0, 3, 6, 7}, {4, 5, 3, 0}});
  CHECK(mesh.near.size() == 2);
  CHECK(mesh.open == std::vector<bool>{false, true, true, true, true, true, false, true});
  CHECK(opposite_sides(mesh)[0] == 4 + 2);
}

TEST_CASE("rework: quads back to back stay where a crease or a fixed node is between them") {
  const SurfaceMesh before = with_flat_pair();
  SurfaceMesh mesh = before;
  drop_flat_pairs(mesh, {{1, 2}});
  CHECK(mesh.faces == before.faces);
  mesh.fixed[2] = 1;
  drop_flat_pairs(mesh, {});
  CHECK(mesh.faces == before.faces);
}

TEST_CASE("rework: a piece with two edges between the same nodes is seen") {
  const SurfaceMesh mesh = with_flat_pair();
  const std::vector<Index> opposite = opposite_sides(mesh);
  CHECK(has_double_edge(Piece(mesh, opposite, {}, {0, 1, 2, 3})));
  CHECK_FALSE(has_double_edge(Piece(mesh, opposite, {}, {0, 1})));
}
