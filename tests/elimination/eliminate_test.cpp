// SPDX-License-Identifier: GPL-2.0-or-later
// Triangle elimination: none is left where the boundary is even, one where it is odd.
#include <doctest/doctest.h>

#include "elimination/eliminate.hpp"
#include "kernel/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using elimination::eliminate_triangles;

/// What must not change, and the number of triangles that are left.
void check_elimination(Mesh mesh, std::size_t left) {
  const Mesh before = mesh;
  CHECK(eliminate_triangles(mesh, {}) == left);
  CHECK(count_triangles(mesh) == int(left));
  CHECK(boundary_of(mesh) == boundary_of(before));
  CHECK(area_of(mesh) == doctest::Approx(area_of(before)));
  for (Index v = 0; v < before.vertex_slots(); ++v)
    if (before.is_fixed(v) || (before.is_live_vertex(v) && before.is_boundary(v))) {
      CHECK(mesh.is_live_vertex(v));
      CHECK(mesh.point(v) == before.point(v));
    }
  CHECK(defect(mesh) == "");
}

//    2---4---6 ..
//  0 |   |   |   1     `quads` cells, a triangle at the left end and perhaps one at the right
//    3---5---7 ..
Mesh strip(Index quads, bool right) {
  std::vector<Vec2> points = {{-0.8, 0.5}, {quads + 0.8, 0.5}};
  Polygons faces = {{0, 3, 2}};
  for (Index i = 0; i <= quads; ++i) {
    points.emplace_back(i, 1);
    points.emplace_back(i, 0);
    const Index top = 2 + 2 * i;
    if (i < quads)
      faces.push_back({top, top + 1, top + 3, top + 2});
    else if (right)
      faces.push_back({top, top + 1, 1});
  }
  if (!right) points[1] = {0, 0};
  return drawn(points, faces);
}

/// A grid in which one cell in each of two opposite corners is cut to half.
Mesh without_corners(Index size, bool both) {
  std::vector<Vec2> points;
  Polygons faces;
  for (Index y = 0; y <= size; ++y)
    for (Index x = 0; x <= size; ++x) points.emplace_back(x, y);
  for (Index y = 0; y < size; ++y)
    for (Index x = 0; x < size; ++x) {
      const Index a = y * (size + 1) + x, b = a + 1, d = a + size + 1, c = d + 1;
      if (x + y == 0)
        faces.push_back({b, c, d});
      else if (both && x + y == 2 * (size - 1))
        faces.push_back({a, b, d});
      else
        faces.push_back({a, b, c, d});
    }
  return drawn(points, faces);
}

}  // namespace

TEST_CASE("elimination: two triangles far apart in a strip of quads meet") {
  for (const Index quads : {1u, 2u, 5u, 12u}) {
    CAPTURE(quads);
    REQUIRE(count_triangles(strip(quads, true)) == 2);
    check_elimination(strip(quads, true), 0);
  }
}

TEST_CASE("elimination: two triangles in opposite corners of a grid meet") {
  for (const Index size : {2u, 4u, 9u}) {
    CAPTURE(size);
    REQUIRE(count_triangles(without_corners(size, true)) == 2);
    check_elimination(without_corners(size, true), 0);
  }
}

TEST_CASE("elimination: a single triangle stays where the boundary is odd") {
  check_elimination(strip(4, false), 1);
  check_elimination(without_corners(5, false), 1);
  check_elimination(drawn({{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}), 1);
}

TEST_CASE("elimination: neighbours become quads, the best pairs first") {
  Mesh mesh = grid(6, 5, Diagonals::rising);
  CHECK(eliminate_triangles(mesh, {}) == 0);
  CHECK(faces_of(mesh) == faces_of(quad_grid(6, 5)));
}

TEST_CASE("elimination: two triangles that fill a chevron of four boundary nodes become valid quads") {
  //  3
  //  |\        0 1 2 3 with a reflex corner at 2; no node can move, so new ones have to come
  //  | 2-.
  //  0----1
  for (const Vec2& corner : {Vec2(0.5, 0.5), Vec2(0.9, 0.9), Vec2(1.2, 0.3)})
    check_elimination(drawn({{0, 0}, {3, 0}, corner, {0, 3}}, {{0, 1, 2}, {0, 2, 3}}), 0);
}

TEST_CASE("elimination: a chevron of four fixed nodes inside a mesh becomes valid quads") {
  //  11-----10       The chevron 0 1 2 3 of the case above inside quads, its nodes fixed.
  Mesh mesh =
      drawn({{0, 0}, {3, 0}, {0.9, 0.9}, {0, 3}, {-2, -2}, {5, -2}, {5, 5}, {-2, 5}, {2.5, 2.5}},
            {{0, 1, 2}, {0, 2, 3}, {4, 5, 1, 0}, {5, 6, 8, 1}, {1, 8, 2}, {2, 8, 3}, {6, 7, 3, 8}, {7, 4, 0, 3}});
  for (Index v = 0; v < 4; ++v) mesh.set_fixed(v);
  REQUIRE(defect(mesh) == "");
  check_elimination(mesh, 0);
}

TEST_CASE("elimination: on random meshes the parity of the boundary decides, and nothing becomes invalid") {
  int odd = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    if (rng.chance(0.5)) {  // cut one triangle off where it has two sides on the boundary: the boundary becomes odd
      std::vector<Vec2> points;
      Polygons faces = faces_of(mesh);
      for (Index v = 0; v < mesh.vertex_slots(); ++v) points.push_back(mesh.point(v));
      const auto is_ear = [&](const std::vector<Index>& f) {
        int outside = 0;
        for (int i = 0; i < 3; ++i) outside += mesh.is_boundary_edge(edge(mesh, f[i], f[(i + 1) % 3]));
        return outside == 2;
      };
      const auto ear = std::find_if(faces.begin(), faces.end(), is_ear);
      if (ear != faces.end()) {
        faces.erase(ear);
        mesh = drawn(points, faces);
      }
    }
    const std::size_t left = boundary_of(mesh).size() % 2;
    odd += int(left);
    check_elimination(mesh, left);
  }
  CHECK(odd > 15);
  CHECK(odd < 85);
}
