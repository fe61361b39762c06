// SPDX-License-Identifier: GPL-2.0-or-later
// Side edges: an edge that is there, a swap, a split; and what parity and size forbid.
#include <doctest/doctest.h>

#include "front/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using front::Corner;
using front::define_side_edge;

/// The corner at node 0 between the front edges 1-0 and 0-2, with the bisector as ideal.
Corner corner_at_0(const Scene& s) {
  const Index in = s.at(1, 0), out = s.at(0, 2);
  return {in, out, s.front.angle_between(in, out) / 2};
}

//   5-----------4
//    \  \   /  /
//     \   3   /        node 3 is inside, at `middle`; its edge to 0 is the only one at 0 between the front edges
//      \ /|\ /
//       1-0-2
Mesh fan(const Vec2& middle) {
  return drawn({{0, 0}, {-1, 0}, {1, 0}, middle, {2, 2}, {-2, 2}},
               {{0, 2, 3}, {0, 3, 1}, {2, 4, 3}, {3, 4, 5}, {3, 5, 1}});
}

//   5-----------4
//    \  \   /  /
//     \   3   /        no edge at 0: the edge 1-2 is opposite
//      \ / \ /
//       1---2
//        \ /
//         0
Mesh wedge(const Vec2& middle) {
  return drawn({{0, -0.5}, {-1, 0}, {1, 0}, middle, {2, 4}, {-2, 4}},
               {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}, {3, 5, 1}});
}

}  // namespace

TEST_CASE("side edge: an edge within pi / 6 of the bisector is used as it is") {
  for (const double off : {0.0, 0.5, -0.5}) {
    CAPTURE(off);
    Scene s(fan(rotated(Vec2(0, 1), off)));
    const Snapshot before = snapshot(s.mesh);
    CHECK(define_side_edge(s.step, corner_at_0(s), {}) == s.at(0, 3));
    CHECK(snapshot(s.mesh) == before);
  }
}

TEST_CASE("side edge: an edge farther off is not") {
  for (const double off : {0.55, -0.55}) {
    CAPTURE(off);
    Scene s(fan(rotated(Vec2(0, 1), off)));
    const Index side = define_side_edge(s.step, corner_at_0(s), {});
    REQUIRE(side != kNone);
    CHECK(s.mesh.origin(side) == 0);
    CHECK(s.mesh.target(side) != 3);
    CHECK(defect(s.mesh) == "");
  }
}

TEST_CASE("side edge: the edge opposite is swapped where the new one has the direction and the length") {
  Scene s(wedge({0.2, 1}));
  const Index side = define_side_edge(s.step, corner_at_0(s), {});
  CHECK(side == s.at(0, 3));
  CHECK(count(s.mesh) == count(wedge({0.2, 1})));
  CHECK(s.mesh.find(1, 2) == kNone);
  CHECK(s.step.moved.empty());
  CHECK(defect(s.mesh) == "");
}

TEST_CASE("side edge: else the edge opposite is split where the bisector meets it") {
  // The far node is farther than sqrt(3) / 2 times both front edges (1.94) or aside by more than pi / 6.
  for (const Vec2& far : {Vec2(0, 1.5), Vec2(0.95, 1)}) {
    CAPTURE(far.x());
    Scene s(wedge(far));
    const Index side = define_side_edge(s.step, corner_at_0(s), {});
    REQUIRE(side != kNone);
    const Index m = s.mesh.target(side);
    CHECK(m == 6);
    CHECK(s.mesh.origin(side) == 0);
    CHECK((s.mesh.point(m) - Vec2(0, 0)).norm() < 1e-12);
    CHECK(faces_of(s.mesh) == Polygons{{0, 2, 6}, {0, 6, 1}, {1, 3, 5}, {1, 6, 3}, {2, 3, 6}, {2, 4, 3}, {3, 4, 5}});
    CHECK(s.step.moved == std::vector<Index>{m});
    CHECK_FALSE(s.colours.is_coloured(m));
    CHECK(s.step.size[m] == doctest::Approx(0.5 * (s.step.size[1] + s.step.size[2])));
    CHECK(defect(s.mesh) == "");
  }
}

TEST_CASE("side edge: a split that would be much shorter than the input's edges is refused") {
  Scene s(wedge({0, 1.5}));
  s.step.size.set(0, 0.5 / 0.31);  // the side edge would have the length 0.5
  CHECK(s.refuses([&] { return define_side_edge(s.step, corner_at_0(s), {}) != kNone; }) == false);
  Scene coarse(wedge({0, 1.5}));
  coarse.step.size.set(0, 0.5 / 0.29);
  CHECK(coarse.refuses([&] { return define_side_edge(coarse.step, corner_at_0(coarse), {}) != kNone; }));
}

TEST_CASE("side edge: to a node on the front it may have any direction, if both loops are even") {
  //    5---3
  //    |  / 4         The loop has six nodes: 0, 2, 4, 3, 5, 1. The node 3 is three steps from 0.
  //    1---2
  //      0
  const std::vector<Vec2> points = {{0, -0.5}, {-1, 0}, {1, 0}, {0.95, 1}, {1.3, 0.5}, {-0.5, 1}};
  Scene s(drawn(points, {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {1, 3, 5}}));
  const Index side = define_side_edge(s.step, corner_at_0(s), {});
  CHECK(side == s.mesh.find(0, 3));
  CHECK(s.mesh.find(1, 2) == kNone);
  CHECK(defect(s.mesh) == "");
}

TEST_CASE("side edge: a swap that would leave odd loops becomes a split") {
  // Loop of four: 0, 2, 3, 1. The node 3 is two steps from 0.
  Scene s(drawn({{0, -0.5}, {-1, 0}, {1, 0}, {0, 0.5}}, {{0, 2, 1}, {1, 2, 3}}));
  const Index side = define_side_edge(s.step, corner_at_0(s), {});
  REQUIRE(side != kNone);
  CHECK(s.mesh.target(side) == 4);
  CHECK(s.mesh.find(0, 3) == kNone);
  CHECK(count_triangles(s.mesh) == 4);
  CHECK(defect(s.mesh) == "");
}

TEST_CASE("side edge: an existing edge that would leave odd loops is used up to its middle") {
  //     3
  //   / | \           four front edges, and the edge 0-3 inside
  //  1--0--2
  Scene s(drawn({{0, 0}, {-1, 0.2}, {1, 0.2}, {0, 1}}, {{0, 2, 3}, {0, 3, 1}}));
  SUBCASE("at a new node in its middle") {
    const Index side = define_side_edge(s.step, corner_at_0(s), {});
    REQUIRE(side != kNone);
    CHECK(s.mesh.origin(side) == 0);
    CHECK(s.mesh.target(side) == 4);
    CHECK(s.mesh.point(4) == Vec2(0, 0.5));
    CHECK(faces_of(s.mesh) == Polygons{{0, 2, 4}, {0, 4, 1}, {1, 4, 3}, {2, 3, 4}});
    CHECK(defect(s.mesh) == "");
  }
  SUBCASE("but not if the half is too short") {
    s.step.size.set(0, 0.5 / 0.29);
    CHECK(s.refuses([&] { return define_side_edge(s.step, corner_at_0(s), {}) != kNone; }));
  }
}

TEST_CASE("side edge: a node and an edge that the other side edge has taken are left alone") {
  SUBCASE("the node") {
    Scene s(fan({0, 1}));
    const Index side = define_side_edge(s.step, corner_at_0(s), {3, kNone});
    CHECK((side == kNone || s.mesh.target(side) != 3));
  }
  SUBCASE("the edge opposite, from either side: then an edge at any angle will do") {
    for (const bool twin : {false, true}) {
      Scene s(fan(rotated(Vec2(0, 1), -0.7)));
      const Index opposite = s.at(3, 1);  // the bisector enters the triangle 0, 3, 1
      const Snapshot before = snapshot(s.mesh);
      CHECK(define_side_edge(s.step, corner_at_0(s), {kNone, twin ? Mesh::twin(opposite) : opposite}) == s.at(0, 3));
      CHECK(snapshot(s.mesh) == before);
    }
  }
  SUBCASE("nothing is left") {
    Scene s(wedge({0, 1}));
    CHECK(s.refuses([&] { return define_side_edge(s.step, corner_at_0(s), {kNone, s.at(2, 1)}) != kNone; }));
  }
}

TEST_CASE("side edge: with a front edge opposite, only existing edges can be used") {
  Scene s(drawn({{0, 0}, {-1, 0.3}, {1, 0.3}}, {{0, 2, 1}}));
  CHECK(s.refuses([&] { return define_side_edge(s.step, corner_at_0(s), {}) != kNone; }));
}

TEST_CASE("split_triangles cuts both triangles at an edge, or the one at the boundary") {
  Scene s(grid(1, 1, Diagonals::rising));
  SUBCASE("inside") {
    const Index m = front::split_triangles(s.step, s.at(0, 3), {0.5, 0.5});
    CHECK(faces_of(s.mesh) == Polygons{{0, 1, m}, {0, m, 2}, {1, 3, m}, {2, m, 3}});
  }
  SUBCASE("on the boundary, from either side") {
    for (const bool outside : {false, true}) {
      Scene copy(grid(1, 1, Diagonals::rising));
      const Index h = outside ? copy.at(1, 0) : copy.at(0, 1);
      const Index m = front::split_triangles(copy.step, h, {0.5, 0});
      CHECK(faces_of(copy.mesh) == Polygons{{0, 3, 2}, {0, m, 3}, {1, 3, m}});
      CHECK(defect(copy.mesh) == "");
    }
  }
  CHECK(defect(s.mesh) == "");
}
