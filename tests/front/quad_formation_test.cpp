// SPDX-License-Identifier: GPL-2.0-or-later
// A ring of edges becomes a face if there are only triangles inside.
#include <doctest/doctest.h>

#include <array>

#include "front/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// 3-------2
/// | 7---6 |      The inner square 4 to 7 is `inside`.
/// | |   | |
/// | 4---5 |
/// 0-------1
Mesh frame(const Polygons& inside) {
  Polygons faces = {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  faces.insert(faces.end(), inside.begin(), inside.end());
  return drawn({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}}, faces);
}
const Polygons kTriangles = {{4, 5, 6}, {4, 6, 7}};

std::vector<Index> outer_ring(const Scene& s) { return {s.at(0, 1), s.at(1, 2), s.at(2, 3), s.at(3, 0)}; }

}  // namespace

TEST_CASE("form_face: everything inside the ring is removed, nodes included") {
  Scene s(frame(kTriangles));
  const Index face = front::form_face(s.step, outer_ring(s), 10);
  REQUIRE(face != kNone);
  CHECK(s.mesh.degree(face) == 4);
  CHECK(faces_of(s.mesh) == Polygons{{0, 1, 2, 3}});
  for (Index v = 4; v < 8; ++v) CHECK_FALSE(s.mesh.is_live_vertex(v));
  CHECK(defect(s.mesh) == "");
}

TEST_CASE("form_face: a ring of three makes a triangle, and what lies outside stays") {
  Scene s(frame(kTriangles));
  const Index face = front::form_face(s.step, std::array{s.at(4, 5), s.at(5, 6), s.at(6, 4)}, 10);
  REQUIRE(face != kNone);
  CHECK(s.mesh.degree(face) == 3);
  CHECK(faces_of(s.mesh) == faces_of(frame(kTriangles)));
}

TEST_CASE("form_face refuses more triangles than allowed") {
  Scene s(frame(kTriangles));
  CHECK(s.refuses([&] { return front::form_face(s.step, outer_ring(s), 9) != kNone; }));
}

TEST_CASE("form_face refuses a hole, a quad, a fixed node inside the ring") {
  SUBCASE("hole") {
    Scene s(frame({}));
    CHECK(s.refuses([&] { return front::form_face(s.step, outer_ring(s), 20) != kNone; }));
  }
  SUBCASE("quad") {
    Scene s(frame({{4, 5, 6, 7}}));
    CHECK(s.refuses([&] { return front::form_face(s.step, outer_ring(s), 20) != kNone; }));
  }
  SUBCASE("fixed node") {
    Mesh mesh = frame(kTriangles);
    mesh.set_fixed(6);
    Scene s(std::move(mesh));
    CHECK(s.refuses([&] { return front::form_face(s.step, outer_ring(s), 20) != kNone; }));
  }
  SUBCASE("but a fixed node on the ring does no harm") {
    Mesh mesh = frame(kTriangles);
    mesh.set_fixed(1);
    Scene s(std::move(mesh));
    CHECK(s.attempt([&] { return front::form_face(s.step, outer_ring(s), 20) != kNone; }));
  }
}

TEST_CASE("form_face refuses a ring whose edges do not enclose one set of triangles") {
  // Two edges of the boundary, two half-edges that look the other way: the flood runs out of the ring.
  Scene s(grid(3, 3, Diagonals::rising));
  const std::vector<Index> inner = {s.at(5, 6), s.at(6, 10), s.at(10, 9), s.at(9, 5)};
  CHECK(s.attempt([&] { return front::form_face(s.step, inner, 20) != kNone; }));
  Scene t(grid(3, 3, Diagonals::rising));
  const std::vector<Index> mixed = {t.at(5, 6), t.at(6, 10), t.at(9, 10), t.at(9, 5)};
  CHECK(t.refuses([&] { return front::form_face(t.step, mixed, 40) != kNone; }));
}
