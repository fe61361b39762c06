// SPDX-License-Identifier: GPL-2.0-or-later
// An edge between two given nodes by swapping what is in its way.
#include <doctest/doctest.h>

#include "front/fixture.hpp"
#include "geometry/predicates.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using front::recover_edge;

/// The first half-edge, counter-clockwise, of the triangles at v.
Index first_of_fan(const Mesh& mesh, Index v) {
  return mesh.is_boundary(v) ? mesh.rotate_ccw(mesh.out(v)) : mesh.out(v);
}

}  // namespace

TEST_CASE("recover_edge: an edge that is there is returned as it is") {
  Scene s(grid(1, 1, Diagonals::rising));
  const Snapshot before = snapshot(s.mesh);
  CHECK(recover_edge(s.step, s.at(0, 1), 3) == s.at(0, 3));
  CHECK(recover_edge(s.step, s.at(0, 1), 1) == s.at(0, 1));  // the edge that the search starts from
  CHECK(recover_edge(s.step, s.at(0, 1), 2) == s.at(0, 2));  // the last of the fan
  CHECK(snapshot(s.mesh) == before);
}

TEST_CASE("recover_edge: one diagonal in the way is flipped") {
  //   2-------3
  //   | \     |     wanted: 0-3, in the way: 1-2
  //   |     \ |
  //   0-------1
  Scene s(grid(1, 1, Diagonals::falling));
  const Index h = recover_edge(s.step, s.at(0, 1), 3);
  REQUIRE(h != kNone);
  CHECK(s.mesh.origin(h) == 0);
  CHECK(s.mesh.target(h) == 3);
  CHECK(faces_of(s.mesh) == Polygons{{0, 1, 3}, {0, 3, 2}});
  CHECK(defect(s.mesh) == "");
}

TEST_CASE("recover_edge: five edges in the way give way one after another") {
  //     7---6---5
  //   / | / | / | \       wanted: 0-4
  //  0  |/  |/  |  4
  //   \ 1---2---3 /
  Scene s(drawn({{0, 0}, {1, -1}, {2, -1}, {3, -1}, {4, 0}, {3, 1}, {2, 1}, {1, 1}},
                {{0, 1, 7}, {1, 6, 7}, {1, 2, 6}, {2, 5, 6}, {2, 3, 5}, {3, 4, 5}}));
  const Edges boundary = boundary_of(s.mesh);
  const Index h = recover_edge(s.step, s.at(0, 1), 4);
  REQUIRE(h != kNone);
  CHECK(h == s.at(0, 4));
  CHECK(count(s.mesh) == Counts{8, 13, 6});
  CHECK(boundary_of(s.mesh) == boundary);
  CHECK(defect(s.mesh) == "");
}

TEST_CASE("recover_edge: what cannot be moved out of the way") {
  SUBCASE("a node on the segment") {
    Scene s(grid(2, 2, Diagonals::falling));
    CHECK(s.refuses([&] { return recover_edge(s.step, s.at(0, 1), 8) != kNone; }));
    Scene rising(grid(2, 2, Diagonals::rising));  // the node is a neighbour of the start
    CHECK(rising.refuses([&] { return recover_edge(rising.step, rising.at(0, 1), 8) != kNone; }));
  }
  SUBCASE("a quad on the way") {
    //   6---7---8
    //   | \ | \ |     wanted: 0-5, which crosses the cell 1, 2, 5, 4
    //   3---4---5
    //   | \ | Q |
    //   0---1---2
    Scene s(grid(2, 2, Diagonals::falling));
    CHECK(s.attempt([&] { return recover_edge(s.step, s.at(0, 1), 5) != kNone; }));
    Scene blocked(grid(2, 2, Diagonals::falling));
    blocked.mesh.join_faces(blocked.at(2, 4));
    CHECK(blocked.refuses([&] { return recover_edge(blocked.step, blocked.at(0, 1), 5) != kNone; }));
  }
  SUBCASE("the outside, in the middle of the segment") {
    //   5---4
    //   | \ |
    //   |   3---2     wanted: 1-4, which cuts the corner at 3
    //   | / . ' |
    //   0-------1
    Scene s(drawn({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}));
    CHECK(s.refuses([&] { return recover_edge(s.step, s.at(1, 2), 4) != kNone; }));
    CHECK(s.refuses([&] { return recover_edge(s.step, s.at(4, 5), 2) != kNone; }));  // outside from the first step
  }
  SUBCASE("a hole") {
    Rng rng(0);
    Scene s(grid(3, 3, Diagonals::falling, rng, [](Index x, Index y) { return x == 1 && y == 1; }));
    CHECK(s.refuses([&] { return recover_edge(s.step, s.at(0, 1), 14) != kNone; }));
  }
}

TEST_CASE("recover_edge: in a convex region without quads only a node on the segment is in the way") {
  int recovered = 0, blocked = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = grid(Index(rng.range(2, 7)), Index(rng.range(2, 7)), Diagonals::random, rng,
                     [](Index, Index) { return false; });
    const double jitter = rng.chance(0.25) ? 0.0 : 0.24;
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      if (!mesh.is_boundary(v))
        mesh.set_point(v, mesh.point(v) + Vec2(rng.between(-jitter, jitter), rng.between(-jitter, jitter)));
    Scene s(std::move(mesh));
    for (int i = 0; i < 20; ++i) {
      const auto from = Index(rng.below(s.mesh.vertex_slots())), to = Index(rng.below(s.mesh.vertex_slots()));
      if (from == to) continue;
      CAPTURE(from);
      CAPTURE(to);
      const Vec2 &p = s.mesh.point(from), &q = s.mesh.point(to);
      bool node_between = false;
      for (Index v = 0; v < s.mesh.vertex_slots(); ++v) {
        const Vec2 &r = s.mesh.point(v), along = q - p;
        const double t = (r - p).dot(along) / along.squaredNorm();
        node_between = node_between || (v != from && v != to && orientation(p, q, r) == 0 && t > 0 && t < 1);
      }
      const Edges boundary = boundary_of(s.mesh);
      const Index h = first_of_fan(s.mesh, from);
      if (node_between) {
        REQUIRE(s.refuses([&] { return recover_edge(s.step, h, to) != kNone; }));
        ++blocked;
      } else {
        REQUIRE(s.attempt([&] { return recover_edge(s.step, h, to) != kNone; }));
        REQUIRE(s.mesh.find(from, to) != kNone);
        ++recovered;
      }
      REQUIRE(defect(s.mesh) == "");
      REQUIRE(boundary_of(s.mesh) == boundary);
    }
  }
  CHECK(recovered > 5000);
  CHECK(blocked > 500);
}
