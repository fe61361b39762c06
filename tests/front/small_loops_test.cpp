// SPDX-License-Identifier: GPL-2.0-or-later
// Loops of four and six edges are closed at once where the quads are good.
#include <doctest/doctest.h>

#include "front/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// As the driver does it: looked for, then filled.
bool close_small_loop(Scene& s, Index h) {
  const front::SmallLoop loop = front::find_small_loop(s.step, s.front.look_at(h));
  return loop.size != 0 && front::close_small_loop(s.step, loop);
}

/// A polygon filled by a fan around `centre`, its last node.
Mesh star(std::vector<Vec2> outline, const Vec2& centre) {
  const auto n = Index(outline.size());
  outline.push_back(centre);
  Polygons fan;
  for (Index i = 0; i < n; ++i) fan.push_back({i, (i + 1) % n, n});
  return drawn(outline, fan);
}

//   5---4---3
//   |       |
//   0---1---2
const std::vector<Vec2> kDomino = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};

}  // namespace

TEST_CASE("small loop: four edges become a quad, from any of them") {
  for (Index i = 0; i < 4; ++i) {
    Scene s(star({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {0.7, 0.6}));
    REQUIRE(s.attempt([&] { return close_small_loop(s, s.at(i, (i + 1) % 4)); }));
    CHECK(faces_of(s.mesh) == Polygons{{0, 1, 2, 3}});
    CHECK(defect(s.mesh) == "");
  }
}

TEST_CASE("small loop: six edges become two quads along the best diagonal") {
  for (Index i = 0; i < 6; ++i) {
    CAPTURE(i);
    Scene s(star(kDomino, {0.9, 0.5}));
    REQUIRE(s.attempt([&] { return close_small_loop(s, s.at(i, (i + 1) % 6)); }));
    CHECK(faces_of(s.mesh) == Polygons{{0, 1, 4, 5}, {1, 2, 3, 4}});
    CHECK(defect(s.mesh) == "");
  }
}

TEST_CASE("small loop: of several diagonals that will do the best is taken") {
  // Bottom and top bulge a little, so that 0-3 and 5-2 make quads too, with blunt corners.
  for (Index i = 0; i < 6; ++i) {
    CAPTURE(i);
    Scene s(star({{0, 0}, {1, -0.3}, {2, 0}, {2, 1}, {1, 1.3}, {0, 1}}, {0.9, 0.5}));
    REQUIRE(s.attempt([&] { return close_small_loop(s, s.at(i, (i + 1) % 6)); }));
    CHECK(faces_of(s.mesh) == Polygons{{0, 1, 4, 5}, {1, 2, 3, 4}});
  }
}

TEST_CASE("small loop: a loop within quads is closed like one at the boundary") {
  //   6---7---8---9         the cell 1, 2, 7... in the middle is left
  Scene s([] {
    Mesh mesh = grid(3, 3, Diagonals::rising);
    for (Index y = 0; y < 3; ++y)
      for (Index x = 0; x < 3; ++x)
        if (x != 1 || y != 1) mesh.join_faces(edge(mesh, 4 * y + x, 4 * y + x + 5));
    return mesh;
  }());
  REQUIRE(s.attempt([&] { return close_small_loop(s, s.at(5, 6)); }));
  CHECK(faces_of(s.mesh) == faces_of(quad_grid(3, 3)));
  for (Index v : {5u, 6u, 9u, 10u}) CHECK((s.mesh.point(v) - Vec2(v % 4, v / 4)).norm() < 1e-9);  // perfect already
}

TEST_CASE("small loop is refused, and nothing changes") {
  const auto refused = [](Mesh mesh, Index a, Index b) {
    Scene s(std::move(mesh));
    return s.refuses([&] { return close_small_loop(s, s.at(a, b)); });
  };
  SUBCASE("three or five or eight edges") {
    for (const Index n : {3u, 5u, 8u}) {
      std::vector<Vec2> outline;
      for (Index i = 0; i < n; ++i) outline.push_back(rotated(Vec2(1, 0), 2 * kPi * i / n));
      CHECK(refused(star(outline, {0, 0}), 0, 1));
    }
  }
  SUBCASE("four edges with a corner that is nearly straight, sharp or reflex") {
    for (const Vec2& corner : {Vec2(1.05, 1.05), Vec2(0.8, 0.8), Vec2(14, 14)}) {
      CAPTURE(corner.x());
      CHECK(refused(drawn({{0, 0}, {2, 0}, corner, {0, 2}}, {{0, 1, 2}, {0, 2, 3}}), 0, 1));
    }
  }
  SUBCASE("a fixed node inside") {
    Mesh mesh = star(kDomino, {0.9, 0.5});
    mesh.set_fixed(6);
    CHECK(refused(std::move(mesh), 0, 1));
  }
  SUBCASE("a hole inside") {
    CHECK(refused(annulus(4), 0, 1));
    CHECK(refused(annulus(6), 0, 1));
  }
  SUBCASE("many triangles inside: the front has work to do there") {
    Scene s(star({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {1, 1}));
    for (const auto& [a, b] : Edges{{0, 4}, {2, 4}})
      front::split_triangles(s.step, s.at(a, b), 0.5 * (s.mesh.point(a) + s.mesh.point(b)));
    REQUIRE(count_triangles(s.mesh) == 8);
    CHECK(s.refuses([&] { return close_small_loop(s, s.at(0, 1)); }));
  }
  SUBCASE("six edges, but no diagonal makes two good quads") {
    // A triangle with a node on each side: every diagonal leaves a quad with two corners in a line.
    CHECK(refused(star({{0, 0}, {1, 0}, {2, 0}, {1, 0.9}, {0, 1.8}, {0, 0.9}}, {0.6, 0.6}), 0, 1));
  }
}
