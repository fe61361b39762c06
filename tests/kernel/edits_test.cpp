// SPDX-License-Identifier: GPL-2.0-or-later
// Every edit of the half-edge mesh on a drawn case.
#include <doctest/doctest.h>

#include "kernel/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

//   3-------2
//   |     / |
//   |   /   |
//   | /     |
//   0-------1
const std::vector<Vec2> kSquare = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
const Polygons kRising = {{0, 1, 2}, {0, 2, 3}};

//   6---7---8
//   |   |   |
//   3---4---5
//   |   |   |
//   0---1---2
Mesh four_quads() { return quad_grid(2, 2); }
const Polygons kFourQuads = {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7}};

}  // namespace

TEST_CASE("a mesh is linked as its triangles are, the outside too") {
  const Mesh mesh(kSquare, {{0, 1, 2}, {0, 2, 3}});
  CHECK(defect(mesh) == "");
  CHECK(count(mesh) == Counts{4, 5, 2});
  CHECK(faces_of(mesh) == kRising);
  CHECK(boundary_of(mesh) == Edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}});
  CHECK(mesh.valence(0) == 3);
  CHECK(mesh.valence(1) == 2);
  CHECK(mesh.find(1, 3) == kNone);
  const Index h = edge(mesh, 0, 2);
  CHECK(mesh.target(mesh.next(h)) == 3);  // its face is the one on the left
  CHECK(mesh.target(mesh.rotate_ccw(h)) == 3);
  CHECK(mesh.target(mesh.rotate_cw(h)) == 1);
  CHECK(mesh.length(h) == doctest::Approx(std::sqrt(8.0)));
  for (Index v = 0; v < 4; ++v) {
    CHECK(mesh.is_boundary(v));
    CHECK(mesh.face(mesh.out(v)) == kNone);
  }
}

TEST_CASE("sides that are open are not joined") {
  // The diagonal is a cut: two triangles that meet nowhere, on six vertices.
  const std::vector<Vec2> points = {{0, 0}, {2, 0}, {2, 2}, {0, 0}, {2, 2}, {0, 2}};
  const Mesh apart(points, {{0, 1, 2}, {3, 4, 5}});
  CHECK(defect(apart) == "");
  CHECK(boundary_of(apart).size() == 6);
  // A cut one edge long around both ends of which the fan goes on, as inside a larger mesh.
  //     3
  //   / | \        The edge 1-2 is open on both sides.
  //  4--1  |
  //  |  :  |
  //  5--2--6
  const std::vector<Vec2> slit = {{9, 9}, {0, 1}, {0, -1}, {0, 3}, {-2, 1}, {-2, -1}, {2, 0}, {0, -3}};
  std::vector<std::array<Index, 3>> triangles = {{1, 2, 6}, {2, 1, 4}, {1, 6, 3}, {1, 3, 4},
                                                 {2, 4, 5}, {2, 5, 7}, {2, 7, 6}};
  std::vector<bool> open(21, false);
  open[0] = open[3] = true;
  const Mesh mesh(slit, triangles, open);
  const Index h = edge(mesh, 1, 2);
  CHECK(defect(mesh) == "");
  CHECK(mesh.is_boundary(1));
  CHECK(mesh.is_boundary(2));
  CHECK(mesh.is_boundary_edge(h));
  CHECK(count(mesh) == Counts{7, 13 + 1, 7});  // the cut counts twice
}

TEST_CASE("split_edge puts a node on an edge and both faces gain a side") {
  Mesh mesh = drawn(kSquare, kRising);
  SUBCASE("inside: 0-m-2") {
    const Index m = mesh.split_edge(edge(mesh, 0, 2), {1, 1});
    CHECK(m == 4);
    CHECK(mesh.point(m) == Vec2(1, 1));
    CHECK(faces_of(mesh) == Polygons{{0, 1, 2, 4}, {0, 4, 2, 3}});
    CHECK_FALSE(mesh.is_boundary(m));
    CHECK(mesh.valence(m) == 2);
  }
  SUBCASE("on the boundary, from inside and from outside") {
    for (const bool outside : {false, true}) {
      Mesh copy = mesh;
      const Index inner = edge(copy, 0, 1), h = outside ? Mesh::twin(inner) : inner, end = copy.origin(h);
      const Index m = copy.split_edge(h, {0.5, 0});
      CHECK(copy.origin(h) == end);  // the half-edge given keeps its origin and ends at the new node
      CHECK(copy.target(h) == m);
      CHECK(faces_of(copy) == Polygons{{0, 2, 3}, {0, 4, 1, 2}});
      CHECK(boundary_of(copy) == Edges{{0, 4}, {1, 2}, {2, 3}, {3, 0}, {4, 1}});
      CHECK(defect(copy, false) == "");
    }
  }
  CHECK(defect(mesh, false) == "");
}

TEST_CASE("attach_triangle puts a face outside of a boundary edge, with a vertex that had none") {
  Mesh mesh = drawn({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {3, 1}}, {{0, 1, 2}, {0, 2, 3}});
  CHECK_FALSE(mesh.is_live_vertex(4));
  const Index f = mesh.attach_triangle(Mesh::twin(edge(mesh, 1, 2)), 4);
  CHECK(mesh.degree(f) == 3);
  CHECK(faces_of(mesh) == Polygons{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}});
  CHECK(boundary_of(mesh) == Edges{{0, 1}, {1, 4}, {2, 3}, {3, 0}, {4, 2}});
  CHECK(defect(mesh) == "");
}

TEST_CASE("split_face cuts a quad; the part that starts with the second half-edge lies on the left") {
  Mesh mesh = drawn(kSquare, {{0, 1, 2, 3}});
  const Index g = edge(mesh, 1, 2), h = edge(mesh, 3, 0), d = mesh.split_face(g, h);
  CHECK(mesh.origin(d) == 1);
  CHECK(mesh.target(d) == 3);
  CHECK(mesh.next(d) == h);
  CHECK(mesh.face(d) == mesh.face(h));
  CHECK(faces_of(mesh) == Polygons{{0, 1, 3}, {1, 2, 3}});
  CHECK(defect(mesh) == "");
}

TEST_CASE("join_faces makes a quad of two triangles and undoes split_face") {
  Mesh mesh = drawn(kSquare, kRising);
  const Index h = edge(mesh, 0, 2), f = mesh.face(h), inner = mesh.join_faces(h);
  CHECK(mesh.face(inner) == f);
  CHECK(mesh.degree(f) == 4);
  CHECK_FALSE(mesh.is_live_half_edge(h));
  CHECK(faces_of(mesh) == Polygons{{0, 1, 2, 3}});
  mesh.split_face(edge(mesh, 0, 1), edge(mesh, 2, 3));
  CHECK(faces_of(mesh) == kRising);
  CHECK(defect(mesh) == "");
}

TEST_CASE("flip turns a diagonal, and four flips turn it all the way") {
  Mesh mesh = drawn(kSquare, kRising);
  const Index h = edge(mesh, 0, 2);
  const std::pair<Index, Index> ends[] = {{1, 3}, {2, 0}, {3, 1}, {0, 2}};
  for (const auto& [from, to] : ends) {
    REQUIRE(mesh.can_flip(h));
    mesh.flip(h);
    CHECK(mesh.origin(h) == from);
    CHECK(mesh.target(h) == to);
    CHECK(faces_of(mesh) == (from % 2 ? Polygons{{0, 1, 3}, {1, 2, 3}} : kRising));
    CHECK(defect(mesh) == "");
  }
}

TEST_CASE("can_flip refuses what would not be a mesh of counter-clockwise triangles") {
  SUBCASE("an edge of the boundary") {
    const Mesh mesh = drawn(kSquare, kRising);
    CHECK_FALSE(mesh.can_flip(edge(mesh, 0, 1)));
    CHECK_FALSE(mesh.can_flip(Mesh::twin(edge(mesh, 0, 1))));
  }
  SUBCASE("a side of a quad") {
    const Mesh mesh = drawn({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {3, 1}}, {{0, 1, 2, 3}, {1, 4, 2}});
    CHECK_FALSE(mesh.can_flip(edge(mesh, 1, 2)));
  }
  SUBCASE("a union that is not convex") {
    //  1 lies inside the triangle 0, 4, 2: the union 0, 1, 2, 3 has a reflex corner.
    const Mesh mesh = drawn({{0, 0}, {1.5, 1}, {2, 2}, {0, 2}}, {{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.can_flip(edge(mesh, 0, 2)));
    const Mesh dart = drawn({{0, 0}, {3, 0}, {0.5, 0.5}, {0, 3}}, {{0, 1, 2}, {0, 2, 3}});
    CHECK_FALSE(dart.can_flip(edge(dart, 0, 2)));
  }
  SUBCASE("a union with a straight corner") {
    const Mesh mesh = drawn({{0, 0}, {1, 0}, {2, 0}, {1, 1}}, {{0, 1, 3}, {1, 2, 3}});
    CHECK_FALSE(mesh.can_flip(edge(mesh, 1, 3)));
  }
  SUBCASE("an edge that is there already, on the other side of a node") {
    //      2
    //    / | \        The edge 2-3 turned would be 0-1 a second time.
    //   /  3  \       .
    //  0-------1
    Mesh mesh = drawn({{0, 0}, {2, 0}, {1, 2}, {1, 1}}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    mesh.set_point(2, {1, 0.5});  // shape alone would now allow it
    mesh.set_point(3, {1, -1});
    const Index h = edge(mesh, 2, 3);
    CHECK_FALSE(mesh.can_flip(h));
  }
}

TEST_CASE("collapse merges a node into its neighbour; the triangles at the edge vanish") {
  //   4---3           4---3
  //   | \ |\          |  /  .
  //   |  5--2   ->    | /  2     node 5 goes into 3
  //   | / \ |         |//
  //   0----1          0----1
  Mesh mesh =
      drawn({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}, {1, 1}}, {{0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {4, 0, 5}});
  const Index h = edge(mesh, 5, 3);
  REQUIRE(mesh.can_collapse(h));
  mesh.collapse(h);
  CHECK(faces_of(mesh) == Polygons{{0, 1, 3}, {0, 3, 4}, {1, 2, 3}});
  CHECK_FALSE(mesh.is_live_vertex(5));
  CHECK(mesh.point(3) == Vec2(2, 2));
  CHECK(defect(mesh, false) == "");
}

TEST_CASE("collapse: a quad at the edge becomes a triangle") {
  Mesh mesh = four_quads();
  const Index h = edge(mesh, 4, 5);
  REQUIRE(mesh.can_collapse(h));
  mesh.collapse(h);
  CHECK(faces_of(mesh) == Polygons{{0, 1, 5, 3}, {1, 2, 5}, {3, 5, 7, 6}, {5, 8, 7}});
  CHECK(boundary_of(mesh) == boundary_of(four_quads()));
  CHECK(defect(mesh, false) == "");
}

TEST_CASE("can_collapse refuses to move the boundary or a fixed node, or to fold the mesh") {
  Mesh mesh = four_quads();
  CHECK_FALSE(mesh.can_collapse(edge(mesh, 5, 4)));  // from the boundary
  mesh.set_fixed(4);
  CHECK_FALSE(mesh.can_collapse(edge(mesh, 4, 5)));

  SUBCASE("a quad with both nodes at opposite corners would meet itself") {
    // Faces (0 1 2), (0 2 1 3), (0 3 4 1): node 2 has the neighbours 0 and 1 alone.
    const Mesh folded = drawn({{0, 0}, {2, 0}, {1, 1}, {0, 2}, {-1, -1}}, {{0, 1, 2}, {2, 1, 3, 0}, {0, 3, 4, 1}});
    REQUIRE(defect(folded, false) == "");
    CHECK_FALSE(folded.can_collapse(edge(folded, 0, 1)));
  }
  SUBCASE("but the centre of a fan goes into any corner") {
    const Mesh square = drawn({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    for (Index corner = 0; corner < 4; ++corner) CHECK(square.can_collapse(edge(square, 4, corner)));
  }
  SUBCASE("a common neighbour that is not the tip of a triangle at the edge") {
    //        2
    //       /|\        4 and 5 are joined and have the common neighbour 2 besides 0 and 1, with node 3 between.
    //      / 3 \       .
    //     / / \ \      .
    //    4-------5     4 is inside a larger triangle 0, 1, 2.
    const std::vector<Vec2> points = {{-6, -4}, {6, -4}, {0, 8}, {0, 1}, {-1, 0}, {1, 0}};
    const Mesh tent = drawn(points, {{4, 5, 3}, {5, 2, 3}, {2, 4, 3}, {0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 0, 4}});
    CHECK(defect(tent) == "");
    CHECK_FALSE(tent.can_collapse(edge(tent, 4, 5)));
    CHECK(tent.can_collapse(edge(tent, 3, 5)));
  }
}

TEST_CASE("open_quad makes room between two edges of a node") {
  //   6---7---8       6---7---8
  //   |   |   |       |   / \   |
  //   3---4---5  ->   3--9 Q 4--5       between 4-1 and 4-7, clockwise seen from the left side
  //   |   |   |       |   \ /   |
  //   0---1---2       0---1---2
  Mesh mesh = four_quads();
  const Index w = mesh.open_quad(edge(mesh, 4, 7), edge(mesh, 4, 1), {0.8, 1});
  CHECK(w == 9);
  CHECK(mesh.point(9) == Vec2(0.8, 1));
  CHECK(faces_of(mesh) == Polygons{{0, 1, 9, 3}, {1, 2, 5, 4}, {1, 4, 7, 9}, {3, 9, 7, 6}, {4, 5, 8, 7}});
  CHECK(mesh.valence(4) == 3);
  CHECK(mesh.valence(9) == 3);
  CHECK(defect(mesh, false) == "");

  SUBCASE("closing it again with a diagonal and a collapse restores the mesh") {
    mesh.split_face(edge(mesh, 9, 1), edge(mesh, 4, 7));
    const Index h = edge(mesh, 9, 4);
    REQUIRE(mesh.can_collapse(h));
    mesh.collapse(h);
    CHECK(faces_of(mesh) == kFourQuads);
    CHECK(defect(mesh) == "");
  }
}

TEST_CASE("open_quad at a boundary node keeps the node on the boundary") {
  //   3---4---5
  //   | / | \ |     at node 1 between 1-3 and 1-5, counter-clockwise from 5
  //   0---1---2
  Mesh mesh = drawn({{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 2}, {2, 1}}, {{0, 1, 3}, {1, 4, 3}, {1, 5, 4}, {1, 2, 5}});
  const Index w = mesh.open_quad(edge(mesh, 1, 5), edge(mesh, 1, 3), {1, 1.5});
  CHECK(faces_of(mesh) == Polygons{{0, 1, 3}, {1, 2, 5}, {1, 5, w, 3}, {3, w, 4}, {4, w, 5}});
  CHECK_FALSE(mesh.is_boundary(w));
  CHECK(mesh.is_boundary(1));
  CHECK(defect(mesh) == "");
}

TEST_CASE("pillow puts a layer of quads between a set of faces and its outline") {
  //   6---7---8
  //   |   | \ |      the triangle 4, 5, 7 becomes smaller, with three quads around it
  //   3---4---5
  Mesh mesh = four_quads();
  mesh.split_face(edge(mesh, 5, 8), edge(mesh, 7, 4));
  const std::vector<Index> loop = {edge(mesh, 4, 5), edge(mesh, 5, 7), edge(mesh, 7, 4)};
  const auto copies = mesh.pillow(loop, 0.5);
  CHECK(copies == std::vector<Index>{9, 10, 11});
  CHECK(faces_of(mesh) == Polygons{{0, 1, 4, 3},
                                   {1, 2, 5, 4},
                                   {3, 4, 7, 6},
                                   {4, 5, 10, 9},
                                   {4, 9, 11, 7},
                                   {5, 7, 11, 10},
                                   {5, 8, 7},
                                   {9, 10, 11}});
  // Node 4 has two edges in the face, to 5 and 7: their middle is (1.5, 1.5), half-way there is (1.25, 1.25).
  CHECK(mesh.point(9) == Vec2(1.25, 1.25));
  CHECK(boundary_of(mesh) == boundary_of(four_quads()));
  CHECK(defect(mesh) == "");
}

TEST_CASE("pillow inside the whole boundary leaves the boundary as it is") {
  Mesh mesh = four_quads();
  std::vector<Index> loop;
  for (const auto& [a, b] : Edges{{0, 1}, {1, 2}, {2, 5}, {5, 8}, {8, 7}, {7, 6}, {6, 3}, {3, 0}})
    loop.push_back(edge(mesh, a, b));
  mesh.pillow(loop, 0.25);
  CHECK(count(mesh) == Counts{17, 28, 12});
  CHECK(boundary_of(mesh) == boundary_of(four_quads()));
  CHECK(mesh.valence(4) == 4);
  for (Index v : {0u, 1u, 2u, 3u, 5u, 6u, 7u, 8u}) {
    CHECK(mesh.is_boundary(v));
    CHECK(mesh.valence(v) == 3);
  }
  CHECK(defect(mesh) == "");
}

TEST_CASE("make_face replaces what lies in a ring, nodes included") {
  //   3-------2
  //   | \   / |
  //   |   4   |      -> one quad
  //   | /   \ |
  //   0-------1
  Mesh mesh = drawn({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  const std::vector<Index> ring = {edge(mesh, 0, 1), edge(mesh, 1, 2), edge(mesh, 2, 3), edge(mesh, 3, 0)};
  const Index quad = mesh.make_face(ring, std::vector<Index>{0, 1, 2, 3});
  CHECK(mesh.half_edge(quad) == ring[0]);
  CHECK(mesh.degree(quad) == 4);
  CHECK(faces_of(mesh) == Polygons{{0, 1, 2, 3}});
  CHECK_FALSE(mesh.is_live_vertex(4));
  CHECK(defect(mesh) == "");
  // The slots of what went are used again, last first.
  CHECK(mesh.split_edge(ring[0], {1, 0}) == 4);
  CHECK(mesh.vertex_slots() == 5);
}

TEST_CASE("valid faces: by sine, a triangle may be thin, a quad may not have a straight corner") {
  Mesh quad = drawn(kSquare, {{0, 1, 2, 3}});
  CHECK(quad.is_valid_face(quad.face(edge(quad, 0, 1))));
  CHECK(quad.smallest_sine(quad.face(edge(quad, 0, 1))) == doctest::Approx(1));
  for (const auto& [corner, valid] : {std::pair(Vec2(1.1, 1.1), true), {Vec2(1, 1), false}, {Vec2(0.9, 0.9), false}}) {
    quad.set_point(2, corner);
    CHECK(quad.is_valid_face(quad.face(edge(quad, 0, 1))) == valid);
    CHECK(quad.is_valid_star(2) == valid);
    CHECK((defect(quad) == "") == valid);
    CHECK((quad.smallest_sine(quad.face(edge(quad, 0, 1))) > 1e-6) == valid);
  }
  Mesh thin = drawn({{0, 0}, {1, 0}, {0.5, 1e-8}}, {{0, 1, 2}});
  CHECK(thin.is_valid_face(0));
  thin.set_point(2, {0.5, 0});
  CHECK_FALSE(thin.is_valid_face(0));
  thin.set_point(2, {0.5, -1});
  CHECK_FALSE(thin.is_valid_face(0));
}
