// SPDX-License-Identifier: GPL-2.0-or-later
// Doublets, layers of quads around a set of faces, and what a set of faces is.
#include <doctest/doctest.h>

#include "kernel/fixture.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

//   3-------2
//   |     / |      two quads that share two sides: 4 is a doublet
//   |   4   |
//   | /     |
//   0-------1
Mesh doublet() { return drawn({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}}, {{4, 0, 1, 2}, {4, 2, 3, 0}}); }

}  // namespace

TEST_CASE("remove_doublet: two quads that share two sides become one") {
  Mesh mesh = doublet();
  const Index face = topology::remove_doublet(mesh, 4);
  CHECK(mesh.degree(face) == 4);
  CHECK(faces_of(mesh) == Polygons{{0, 1, 2, 3}});
  CHECK_FALSE(mesh.is_live_vertex(4));
  CHECK(defect(mesh) == "");
}

TEST_CASE("remove_doublets: a quad and a triangle become a triangle") {
  Mesh mesh = drawn({{0, 0}, {2, 0}, {2, 2}, {1, 0.9}}, {{3, 0, 1, 2}, {3, 2, 0}});
  REQUIRE(defect(mesh, false) == "");
  std::vector<Index> nodes = {3};
  topology::remove_doublets(mesh, nodes);
  CHECK(faces_of(mesh) == Polygons{{0, 1, 2}});
  CHECK(nodes == std::vector<Index>{0, 1, 2});
  CHECK(defect(mesh) == "");
}

TEST_CASE("remove_doublets: the removal of one can make the next") {
  //  Quads (0 1 2 4), (0 4 2 5), (0 5 2 3) share 0 and 2: both 4 and 5 have two neighbours.
  Mesh mesh =
      drawn({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1.3, 0.7}, {0.7, 1.3}}, {{4, 0, 1, 2}, {4, 2, 5, 0}, {5, 2, 3, 0}});
  REQUIRE(defect(mesh, false) == "");
  std::vector<Index> nodes = {4, 5};
  topology::remove_doublets(mesh, nodes);
  CHECK(faces_of(mesh) == Polygons{{0, 1, 2, 3}});
  CHECK(defect(mesh) == "");
}

TEST_CASE("remove_doublets leaves what is not a doublet, or must stay") {
  const auto unchanged = [](Mesh mesh, std::vector<Index> nodes) {
    const Snapshot before = snapshot(mesh);
    topology::remove_doublets(mesh, nodes);
    return snapshot(mesh) == before;
  };
  CHECK(unchanged(quad_grid(2, 2), {0, 1, 2, 3, 4, 5, 6, 7, 8}));  // corners have two neighbours, but are boundary
  Mesh fixed = doublet();
  fixed.set_fixed(4);
  CHECK(unchanged(fixed, {4}));
  CHECK_FALSE(unchanged(doublet(), {4}));
}

TEST_CASE("remove_doublets leaves two quads that have three sides in common") {
  //  Between two edges that join 2 and 3: quads (2 3 7 6) and (3 2 6 7), 6 and 7 both with two neighbours.
  Mesh mesh = quad_grid(1, 2);
  std::vector<Index> nodes;
  const Index path = topology::draw_path(mesh, 2, 3, {{0.3, 1}, {0.6, 1}}, nodes);
  const Index back = mesh.degree(mesh.face(path)) == 6 ? path : Mesh::twin(mesh.next(mesh.next(path)));
  mesh.split_face(back, mesh.next(mesh.next(mesh.next(back))));
  const Snapshot before = snapshot(mesh);
  topology::remove_doublets(mesh, nodes);
  CHECK(snapshot(mesh) == before);
  CHECK(nodes == std::vector<Index>{6, 7});
}

TEST_CASE("grow adds the faces that share a node, ring by ring") {
  const Mesh mesh = quad_grid(5, 5);
  const Index middle = mesh.face(edge(mesh, 14, 15));  // the cell in column 2, row 2
  CHECK(topology::grow(mesh, {middle}, 0) == std::vector<Index>{middle});
  CHECK(topology::grow(mesh, {middle}, 1).size() == 9);
  CHECK(topology::grow(mesh, {middle}, 2).size() == 25);
  CHECK(topology::grow(mesh, {middle}, 3).size() == 25);
}

TEST_CASE("nodes_of and smallest_sine see a face as its nodes") {
  const Mesh mesh = quad_grid(1, 1);
  auto nodes = topology::nodes_of(mesh, mesh.face(edge(mesh, 0, 1)));
  std::rotate(nodes.begin(), std::find(nodes.begin(), nodes.end(), 0u), nodes.end());
  CHECK(nodes == std::vector<Index>{0, 1, 3, 2});
  CHECK(topology::smallest_sine(mesh, nodes) == doctest::Approx(1));
  CHECK(topology::smallest_sine(mesh, {0, 1, 3}) == doctest::Approx(std::sqrt(0.5)));
  CHECK(topology::smallest_sine(mesh, {3, 1, 0}) < 0);
}

TEST_CASE("pillow: one cell inside a grid gets a layer of four quads") {
  Mesh mesh = quad_grid(3, 3);
  std::vector<Index> nodes = {77};
  REQUIRE(topology::pillow(mesh, {mesh.face(edge(mesh, 5, 6))}, nodes));
  CHECK(nodes.size() == 5);
  CHECK(nodes[0] == 77);  // appended
  CHECK(count(mesh) == Counts{20, 32, 13});
  for (Index v : {5u, 6u, 9u, 10u}) CHECK(mesh.valence(v) == 5);  // two edges more, none less
  CHECK(boundary_of(mesh) == boundary_of(quad_grid(3, 3)));
  CHECK(defect(mesh) == "");
}

TEST_CASE("pillow: a ring of faces gets a layer on both sides") {
  Mesh mesh = quad_grid(5, 5);
  std::vector<Index> ring, nodes;
  for (Index x = 1; x < 4; ++x)
    for (Index y = 1; y < 4; ++y)
      if (x != 2 || y != 2) ring.push_back(mesh.face(edge(mesh, 6 * y + x, 6 * y + x + 1)));
  REQUIRE(topology::pillow(mesh, ring, nodes));
  CHECK(nodes.size() == 12 + 4);
  CHECK(count_quads(mesh) == 25 + 16);
  CHECK(boundary_of(mesh) == boundary_of(quad_grid(5, 5)));
  CHECK(defect(mesh, false) == "");  // at a corner of the hole the copy may lie on its node: smoothing follows
}

TEST_CASE("pillow refuses an outline that touches itself, and then changes nothing") {
  //  . x      two cells that share a node
  //  x .
  Mesh mesh = quad_grid(2, 2);
  const Snapshot before = snapshot(mesh);
  std::vector<Index> nodes;
  CHECK_FALSE(topology::pillow(mesh, {mesh.face(edge(mesh, 0, 1)), mesh.face(edge(mesh, 4, 5))}, nodes));
  CHECK(snapshot(mesh) == before);
  CHECK(nodes.empty());
}

TEST_CASE("connectivity: which nodes make the faces, in any order, and nothing else") {
  const std::vector<Vec2> points{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};
  const auto of = [&](const Polygons& faces) { return topology::connectivity(drawn(points, faces)); };
  CHECK(of({{0, 1, 4, 5}, {1, 2, 3, 4}}) == of({{2, 3, 4, 1}, {4, 5, 0, 1}}));
  CHECK(of({{0, 1, 4, 5}, {1, 2, 3, 4}}) != of({{0, 1, 2, 5}, {2, 3, 4, 5}}));
  const Mesh both = drawn(points, {{0, 1, 4, 5}, {1, 2, 3, 4}});
  std::uint64_t sum = 0;
  for (Index f = 0; f < both.face_slots(); ++f)
    if (both.is_live_face(f)) sum += topology::connectivity(both, {f});
  CHECK(sum == topology::connectivity(both));
  Mesh moved = both;
  moved.set_point(4, {1.1, 1});
  CHECK(topology::connectivity(moved) == topology::connectivity(both));
}
