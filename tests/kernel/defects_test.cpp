// SPDX-License-Identifier: GPL-2.0-or-later
// find_defects sees meshes that are not legal, as far as they can be made at all.
#include <doctest/doctest.h>

#include "kernel/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

bool says(const Mesh& mesh, const std::string& words, bool geometry = false) {
  for (const std::string& text : find_defects(mesh, geometry))
    if (text.find(words) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("find_defects: a face of five or six sides") {
  Mesh mesh = quad_grid(2, 1);
  SUBCASE("five") {
    mesh.split_edge(edge(mesh, 0, 1), {0.5, 0});
    CHECK(says(mesh, "5 sides"));
  }
  SUBCASE("six") {
    mesh.join_faces(edge(mesh, 1, 4));
    CHECK(says(mesh, "6 sides"));
  }
}

TEST_CASE("find_defects: an edge that ends nowhere") {
  //   3-----2      Both quads share 0-4 and 4-2; without 0-4 the node 4 has one edge.
  //   |  4  |
  //   0-----1
  Mesh mesh = drawn({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}}, {{4, 0, 1, 2}, {4, 2, 3, 0}});
  CHECK(defect(mesh, false) == "");
  mesh.join_faces(edge(mesh, 0, 4));
  CHECK(says(mesh, "6 sides"));
  CHECK(says(mesh, "valence under 2"));
}

TEST_CASE("find_defects: two inner edges between the same nodes") {
  // Two quads that share two sides, each cut along the same pair of nodes.
  Mesh mesh = drawn({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}}, {{4, 0, 1, 2}, {4, 2, 3, 0}});
  mesh.split_face(edge(mesh, 0, 1), edge(mesh, 2, 4));
  CHECK(defect(mesh, false) == "");
  mesh.split_face(edge(mesh, 0, 4), edge(mesh, 2, 3));
  CHECK(says(mesh, "two edges to one neighbour"));
}

TEST_CASE("find_defects: two fans of triangles that share a node") {
  //   3---4
  //    \ /
  //     0       one node with two stretches of boundary
  //    / \      .
  //   1---2
  const Mesh mesh({{0, 0}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}, {{0, 1, 2}, {0, 4, 3}});
  CHECK(defect(mesh) != "");
}

TEST_CASE("find_defects: with geometry, a corner that is not convex, and where") {
  Mesh mesh = quad_grid(2, 2);
  CHECK(defect(mesh) == "");
  mesh.set_point(4, {-0.5, 1});
  CHECK(defect(mesh, false) == "");
  CHECK(says(mesh, "not strictly convex", true));
  CHECK(says(mesh, "near (", true));
}

TEST_CASE(
    "find_defects: a straight corner of a quad is a defect, one where two triangles meet on the boundary is not") {
  Mesh mesh = drawn({{0, 0}, {1, 0}, {2, 0}, {1, 1}}, {{0, 1, 3}, {1, 2, 3}});
  CHECK(defect(mesh) == "");
  mesh.join_faces(edge(mesh, 1, 3));
  CHECK(says(mesh, "not strictly convex", true));
}

TEST_CASE("find_defects: an inner edge and an edge of the boundary between the same nodes") {
  //     1            Three triangles around node 4 fill the triangle 0, 1, 2, whose side 0-2 is boundary; on its
  //   / | \          other sides lies, folded over, the quad 0, 1, 2, 3. Its diagonal 0-2 would be a second edge.
  //  0--4--2         Shape does not matter here.
  //   \   /
  //     3
  Mesh mesh = drawn({{-1, 0}, {0, 1}, {1, 0}, {0, -1}, {0, 0.3}}, {{1, 2, 3, 0}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}});
  mesh.split_face(edge(mesh, 0, 1), edge(mesh, 2, 3));
  CHECK(defect(mesh, false) != "");
}
