// SPDX-License-Identifier: GPL-2.0-or-later
// Discs of quads around a node, ring by ring.
#include "cleanup/cavity.hpp"

#include <doctest/doctest.h>

#include "cleanup/fixture.hpp"
#include "cleanup/rings.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using cleanup::Cavity;

constexpr std::size_t kAnyNumber = 1000;
constexpr Index kMiddle = 40;  ///< of a grid of 8 x 8 cells

/// By a ring of quads.
bool grow(const Mesh& mesh, Cavity& cavity, std::size_t most) {
  std::vector<Index> nodes;
  for (Index h : cavity.outline())
    if (mesh.is_free(mesh.origin(h))) nodes.push_back(mesh.origin(h));
  return cavity.add_nodes(nodes, most);
}

}  // namespace

TEST_CASE("cavity: around a node of a grid it is four quads with eight edges, then sixteen with sixteen") {
  const Mesh mesh = quad_grid(8, 8);
  Cavity cavity(mesh);
  REQUIRE(cavity.start(kMiddle));
  CHECK(cavity.faces().size() == 4);
  CHECK(cavity.outline().size() == 8);
  CHECK(cavity.inner_nodes() == std::vector<Index>{kMiddle});
  REQUIRE(grow(mesh, cavity, kAnyNumber));
  CHECK(cavity.faces().size() == 16);
  CHECK(cavity.outline().size() == 16);
  CHECK(cavity.inner_nodes().size() == 9);
}

TEST_CASE("cavity: around an irregular node the outline has two edges for each of its own") {
  for (int edges : {3, 5, 6}) {
    const Mesh mesh = surrounded(std::vector<int>(2 * edges, 4));
    Cavity cavity(mesh);
    REQUIRE(cavity.start(0));
    CHECK(cavity.faces().size() == std::size_t(edges));
    CHECK(cavity.outline().size() == std::size_t(2 * edges));
  }
}

TEST_CASE("cavity: the outline goes round the disc counter-clockwise and knows the edges outside") {
  const Mesh mesh = quad_grid(8, 8);
  Cavity cavity(mesh);
  REQUIRE(cavity.start(kMiddle));
  double twice_area = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const Index h = cavity.outline()[i];
    CHECK(mesh.target(h) == mesh.origin(cavity.outline()[(i + 1) % 8]));
    const Vec2 p = mesh.point(mesh.origin(h)), q = mesh.point(mesh.target(h));
    twice_area += cross(p, q);
    const bool is_corner = p.x() != 4 && p.y() != 4;
    CHECK(cavity.outer_edges()[i] == (is_corner ? 4 : 3));
  }
  CHECK(twice_area == 8);
}

TEST_CASE("cavity: it does not start at a node that must stay, nor grow over one") {
  Mesh mesh = quad_grid(8, 8);
  mesh.set_fixed(kMiddle + 1);
  Cavity cavity(mesh);
  CHECK_FALSE(cavity.start(0));  // the grid's corner
  CHECK_FALSE(cavity.start(4));  // on its side
  CHECK_FALSE(cavity.start(kMiddle + 1));
  REQUIRE(cavity.start(kMiddle));  // the fixed node is on the outline
  CHECK_FALSE(grow(mesh, cavity, kAnyNumber));
}

TEST_CASE("cavity: it grows to the boundary and no further") {
  const Mesh mesh = quad_grid(4, 4);
  Cavity cavity(mesh);
  REQUIRE(cavity.start(12));
  REQUIRE(grow(mesh, cavity, 16));
  CHECK(cavity.faces().size() == 16);
  REQUIRE(grow(mesh, cavity, 16));
  CHECK(cavity.faces().size() == 16);
}

TEST_CASE("cavity: it does not grow beyond the number of quads that is allowed") {
  const Mesh mesh = quad_grid(8, 8);
  Cavity cavity(mesh);
  REQUIRE(cavity.start(kMiddle));
  CHECK_FALSE(grow(mesh, cavity, 15));
  REQUIRE(cavity.start(kMiddle));
  CHECK(grow(mesh, cavity, 16));
}

TEST_CASE("cavity: where it cannot grow it stays as it is, and can grow elsewhere") {
  Mesh mesh = quad_grid(8, 8);
  mesh.set_fixed(kMiddle + 1);
  Cavity cavity(mesh);
  REQUIRE(cavity.start(kMiddle));
  const auto faces = cavity.faces(), outline = cavity.outline(), inner = cavity.inner_nodes();
  const auto outer = cavity.outer_edges();
  CHECK_FALSE(grow(mesh, cavity, kAnyNumber));
  CHECK_FALSE(cavity.add_nodes({kMiddle - 1}, 5));
  CHECK(cavity.faces() == faces);
  CHECK(cavity.outline() == outline);
  CHECK(cavity.inner_nodes() == inner);
  CHECK(cavity.outer_edges() == outer);
  CHECK(cavity.add_nodes({kMiddle - 1}, kAnyNumber));
  CHECK(cavity.faces().size() == 6);
  CHECK(cavity.inner_nodes() == std::vector<Index>{kMiddle, kMiddle - 1});
}

TEST_CASE("cavity: it grows to a node farther away with all that lies between them") {
  const Mesh mesh = quad_grid(12, 12);
  const auto node = [](Index x, Index y) { return 13 * y + x; };
  Cavity cavity(mesh);
  REQUIRE(cavity.start(node(3, 3)));
  CHECK(cavity.touches(node(4, 4)));
  CHECK_FALSE(cavity.touches(node(5, 3)));
  REQUIRE(cavity.add_nodes(
      {node(8, 7), node(8, 6), node(8, 5), node(8, 4), node(8, 3), node(7, 3), node(6, 3), node(5, 3), node(4, 3)},
      kAnyNumber));
  CHECK(cavity.faces().size() == 7 * 6);
  CHECK(cavity.is_inside(node(5, 6)));
  CHECK_FALSE(cavity.is_inside(node(2, 2)));
}

TEST_CASE("cavity: a triangle is never part of it") {
  Mesh mesh = quad_grid(8, 8);
  const Index h = edge(mesh, kMiddle, kMiddle + 1);
  mesh.split_face(h, mesh.next(mesh.next(h)));
  Cavity cavity(mesh);
  CHECK_FALSE(cavity.start(kMiddle));
  CHECK_FALSE(cavity.start_with_all());
  REQUIRE(cavity.start(kMiddle - 1));
  CHECK_FALSE(grow(mesh, cavity, kAnyNumber));
}

TEST_CASE("cavity: all faces are a cavity if the mesh is a disc whose inner nodes are free") {
  Mesh mesh = quad_grid(3, 2);
  Cavity cavity(mesh);
  REQUIRE(cavity.start_with_all());
  CHECK(cavity.faces().size() == 6);
  CHECK(cavity.outline().size() == 10);
  CHECK(cavity.inner_nodes().size() == 2);
  mesh.set_fixed(5);
  CHECK_FALSE(cavity.start_with_all());
}

TEST_CASE("cavity: a ring is no disc") {
  // 3 x 3 cells without the one in the middle.
  std::vector<Vec2> points;
  Polygons faces;
  for (Index y = 0; y < 4; ++y)
    for (Index x = 0; x < 4; ++x) points.emplace_back(x, y);
  for (Index y = 0; y < 3; ++y)
    for (Index x = 0; x < 3; ++x)
      if (x != 1 || y != 1) faces.push_back({4 * y + x, 4 * y + x + 1, 4 * y + x + 5, 4 * y + x + 4});
  const Mesh mesh = drawn(points, faces);
  CHECK_FALSE(Cavity(mesh).start_with_all());
}

TEST_CASE("cavity: quads without which the outline would be concave are taken in") {
  const Mesh mesh = grid_with_block(12, 12, 5, 2, 3, {0, 2, 4, 6, 8});
  Cavity cavity(mesh);
  int grown = 0;
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v) || mesh.is_boundary(v) || mesh.valence(v) == 4 || !cavity.start(v)) continue;
    for (int step = 0; step < 2; ++step) {
      for (std::size_t i = 0; i < cavity.outline().size(); ++i)
        if (mesh.is_free(mesh.origin(cavity.outline()[i]))) CHECK(cavity.outer_edges()[i] > 2);
      grown += cavity.faces().size() > mesh.valence(v);
      if (!grow(mesh, cavity, kAnyNumber)) break;
    }
  }
  CHECK(grown > 0);
}
