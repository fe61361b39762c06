// SPDX-License-Identifier: GPL-2.0-or-later
// Seam, transition seam and transition split: small meshes in, small meshes out, drawn both ways round.
#include <doctest/doctest.h>

#include "front/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// A drawing, or its mirror image.
Mesh mirrored(std::vector<Vec2> points, Polygons faces, bool mirror) {
  if (mirror) {
    for (Vec2& p : points) p.x() = -p.x();
    for (auto& f : faces) std::reverse(f.begin() + 1, f.end());
  }
  return drawn(points, faces);
}
Polygons oriented(Polygons faces, bool mirror) {
  for (auto& f : faces) {
    if (mirror) std::reverse(f.begin(), f.end());
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

struct Gap {
  Index in, out;
};
/// The front edges p-k and k-n as they meet at k, with the triangles on their left.
Gap gap(const Scene& s, Index p, Index k, Index n, bool mirror) {
  return mirror ? Gap{s.at(n, k), s.at(k, p)} : Gap{s.at(p, k), s.at(k, n)};
}

//        8
//      /   \          A narrow gap 1-0-2 between quads, open to the top:
//   4  1   2  6       0 k, 1 p, 2 n; quads (k p 4 3), (k 3 5 7), (k 7 6 2)
//   |   \ /   |
//    3---0---7
//        5
const std::vector<Vec2> kPoints = {{0, 0},    {-0.2, 1}, {0.2, 1},  {-1, -0.5}, {-1.5, 1},
                                   {0, -1.5}, {1.5, 1},  {1, -0.5}, {0, 2.5}};
const Polygons kFaces = {{0, 1, 4, 3}, {0, 3, 5, 7}, {0, 7, 6, 2}, {0, 2, 1}, {1, 2, 8}, {1, 8, 4}, {2, 6, 8}};

}  // namespace

TEST_CASE("seam: two edges become one, the triangle between them vanishes") {
  Scene s(drawn(kPoints, kFaces));
  const Edges boundary = boundary_of(s.mesh);
  s.front.set_level(s.at(1, 0), 1);
  s.front.set_level(s.at(0, 2), 3);
  REQUIRE(s.attempt([&] { return front::seam(s.step, s.at(1, 0), s.at(0, 2)); }));
  // Node 1 went into node 2, half-way, and smoothing keeps both on the axis of the drawing.
  CHECK_FALSE(s.mesh.is_live_vertex(1));
  CHECK(faces_of(s.mesh) == Polygons{{0, 2, 4, 3}, {0, 3, 5, 7}, {0, 7, 6, 2}, {2, 6, 8}, {2, 8, 4}});
  CHECK(std::abs(s.mesh.point(2).x()) < 1e-12);
  CHECK(std::abs(s.mesh.point(0).x()) < 1e-12);
  CHECK(boundary_of(s.mesh) == boundary);
  CHECK(defect(s.mesh) == "");
  // The front goes on over the sewn node with the higher of the levels.
  CHECK(s.loop_nodes(s.at(4, 2)) == std::vector<Index>{4, 2, 6, 8});
  CHECK(s.front.level(s.at(4, 2)) == 3);
  CHECK(s.front.level(s.at(2, 6)) == 3);
}

TEST_CASE("seam: a gap of several triangles is cleared first") {
  // A node in the gap, which goes.
  std::vector<Vec2> points = kPoints;
  points.emplace_back(0, 0.8);
  Polygons faces = kFaces;
  faces.erase(faces.begin() + 3);
  faces.insert(faces.end(), {{0, 2, 9}, {0, 9, 1}, {1, 9, 2}});
  Scene s(drawn(points, faces));
  REQUIRE(s.attempt([&] { return front::seam(s.step, s.at(1, 0), s.at(0, 2)); }));
  CHECK_FALSE(s.mesh.is_live_vertex(9));
  CHECK(count_quads(s.mesh) == 3);
  CHECK(count_triangles(s.mesh) == 2);
  CHECK(defect(s.mesh) == "");
}

TEST_CASE("seam: a fixed node stays where it is, the other is merged into it") {
  for (const Index fixed : {1u, 2u}) {
    CAPTURE(fixed);
    Mesh mesh = drawn(kPoints, kFaces);
    mesh.set_fixed(fixed);
    Scene s(std::move(mesh));
    REQUIRE(s.attempt([&] { return front::seam(s.step, s.at(1, 0), s.at(0, 2)); }));
    CHECK(s.mesh.is_live_vertex(fixed));
    CHECK_FALSE(s.mesh.is_live_vertex(3 - fixed));
    CHECK(s.mesh.point(fixed) == kPoints[fixed]);
    CHECK(defect(s.mesh) == "");
  }
}

TEST_CASE("seam is refused, and nothing changes") {
  const auto refused = [](Mesh mesh) {
    Scene s(std::move(mesh));
    return s.refuses([&] { return front::seam(s.step, s.at(1, 0), s.at(0, 2)); });
  };
  SUBCASE("both nodes are fixed") {
    Mesh mesh = drawn(kPoints, kFaces);
    mesh.set_fixed(1);
    mesh.set_fixed(2);
    CHECK(refused(std::move(mesh)));
  }
  SUBCASE("a fixed node in the gap would vanish") {
    std::vector<Vec2> points = kPoints;
    points.emplace_back(0, 0.8);
    Polygons faces = kFaces;
    faces.erase(faces.begin() + 3);
    faces.insert(faces.end(), {{0, 2, 9}, {0, 9, 1}, {1, 9, 2}});
    Mesh mesh = drawn(points, faces);
    mesh.set_fixed(9);
    CHECK(refused(std::move(mesh)));
  }
  SUBCASE("two quads at the node would leave a doublet") {
    //      6
    //    1   2         quads (0 1 4 3) and (0 3 5 2)
    //  4   0   5
    //      3
    const Mesh mesh = drawn({{0, 0}, {-0.2, 1}, {0.2, 1}, {0, -1.5}, {-1.5, 0.5}, {1.5, 0.5}, {0, 2.5}},
                            {{0, 1, 4, 3}, {0, 3, 5, 2}, {0, 2, 1}, {1, 2, 6}, {1, 6, 4}, {2, 5, 6}});
    REQUIRE(defect(mesh) == "");
    CHECK(refused(mesh));
  }
  SUBCASE("the node between them is on the boundary") {
    //  1   2
    //   \ /
    //    0      the square below is missing: 0 is on the boundary
    Polygons faces = kFaces;
    faces.erase(faces.begin() + 1);
    CHECK(refused(drawn(kPoints, faces)));
  }
}

namespace {

//   4------1         8      0 k; the long front edge 1-0 and the short one 0-2 meet at a sharp angle
//   |      |
//   |      |  2------6      quads (k 1 4 3), (k 3 5 7), (k 7 6 2)
//   3----- 0 -----7
//          5
const std::vector<Vec2> kLong = {{0, 0},    {-0.3, 3},  {0.2, 0.9},  {-1.5, 0}, {-1.8, 3},
                                 {0, -1.5}, {1.2, 0.9}, {1.2, -0.1}, {1.2, 3}};
const Polygons kLongFaces = {{0, 1, 4, 3}, {0, 3, 5, 7}, {0, 7, 6, 2}, {0, 2, 1}, {2, 8, 1}, {2, 6, 8}};

}  // namespace

TEST_CASE("transition seam: the long edge is split, and its near half sewn to the short edge by a quad") {
  for (const bool mirror : {false, true}) {
    CAPTURE(mirror);
    Scene s(mirrored(kLong, kLongFaces, mirror));
    REQUIRE(defect(s.mesh) == "");
    const Edges boundary = boundary_of(s.mesh);
    const Gap g = gap(s, 1, 0, 2, mirror);
    s.front.set_level(g.in, 2);
    REQUIRE(s.attempt([&] { return front::transition_seam(s.step, g.in, g.out); }));
    const Index m = 9;
    CHECK(faces_of(s.mesh) ==
          oriented({{0, 2, m, 3}, {m, 1, 4, 3}, {0, 3, 5, 7}, {0, 7, 6, 2}, {2, 1, m}, {2, 8, 1}, {2, 6, 8}}, mirror));
    CHECK(boundary_of(s.mesh) == boundary);
    CHECK(defect(s.mesh) == "");
    CHECK_FALSE(s.colours.may_join(m, 0));  // the colour of the node between the edges
    const Index far_half = mirror ? s.at(m, 1) : s.at(1, m), rest = mirror ? s.at(2, m) : s.at(m, 2);
    for (Index h : {far_half, rest}) {
      CHECK(s.front.contains(h));
      CHECK(s.front.level(h) == 2);
    }
  }
}

TEST_CASE("transition seam is refused, and nothing changes") {
  SUBCASE("no quad behind the long edge") {
    Polygons faces = kLongFaces;
    faces[0] = {0, 1, 3};
    faces.push_back({1, 4, 3});
    Scene s(drawn(kLong, faces));
    CHECK(s.refuses([&] { return front::transition_seam(s.step, s.at(1, 0), s.at(0, 2)); }));
  }
  SUBCASE("the half of the long edge would be short for what the input has there") {
    Scene s(drawn(kLong, kLongFaces));
    s.step.size.set(0, 2.5);
    CHECK(s.refuses([&] { return front::transition_seam(s.step, s.at(1, 0), s.at(0, 2)); }));
  }
}

namespace {

//          5
//       /     \       the long front edge 1-0 goes on as the short one 0-2; quads behind: (0 1 3 4), (2 0 4 6)
//   1-------0--2
//   |       |  |
//    3------4--6
std::vector<Vec2> straight(const Vec2& corner) {
  return {{0, 0}, {-3, 0}, {0.8, 0}, corner, {0, -1.5}, {-1, 2.5}, {0.8, -1.5}};
}
const Polygons kStraight = {{0, 1, 3, 4}, {2, 0, 4, 6}, {1, 0, 5}, {0, 2, 5}};

void check_transition_split(const Vec2& corner, bool mirror) {
  Scene s(mirrored(straight(corner), kStraight, mirror));
  REQUIRE(defect(s.mesh) == "");
  const Edges boundary = boundary_of(s.mesh);
  const Gap g = gap(s, 1, 0, 2, mirror);
  const Index longer = mirror ? g.out : g.in;
  s.front.set_level(longer, 4);
  Index base = kNone;
  REQUIRE(s.attempt([&] {
    base = front::transition_split(s.step, longer, 0);
    return base != kNone;
  }));
  const Index m = 7, c = 8;
  CHECK(faces_of(s.mesh) ==
        oriented({{0, m, c, 4}, {c, 1, 3, 4}, {2, 0, 4, 6}, {1, c, m}, {1, m, 5}, {m, 0, 5}, {0, 2, 5}}, mirror));
  CHECK(boundary_of(s.mesh) == boundary);
  CHECK(defect(s.mesh) == "");
  // The new base edge joins the new nodes; the front runs 1, c, m, 0.
  CHECK(base == (mirror ? s.at(m, c) : s.at(c, m)));
  CHECK(s.front.contains(base));
  CHECK(s.front.contains(mirror ? s.at(c, 1) : s.at(1, c)));
  CHECK(s.front.level(base) == 4);
  CHECK(s.colours.may_join(m, 0));
  CHECK_FALSE(s.colours.may_join(c, 0));
  CHECK(s.colours.may_join(c, 1));
}

}  // namespace

TEST_CASE("transition split: the quad behind the long edge becomes two, and a triangle is ahead of it") {
  check_transition_split({-2.5, -1.2}, false);
  check_transition_split({-2.5, -1.2}, true);
}

// With c at the centroid, as in the thesis, the far quad would have a straight corner in a parallelogram and a reflex
// one in a quad whose far corner is farther out.
TEST_CASE("transition split: behind the long edge is a rectangle, or a quad that bulges") {
  check_transition_split({-3, -1.5}, false);
  check_transition_split({-3.5, -2}, true);
}

TEST_CASE("transition split is refused, and nothing changes") {
  SUBCASE("the long edge is on the boundary") {
    Polygons faces = kStraight;
    faces.erase(faces.begin());
    Scene s(drawn(straight({-2.5, -1.2}), faces));
    CHECK(s.refuses([&] { return front::transition_split(s.step, s.at(1, 0), 0) != kNone; }));
  }
  SUBCASE("half the long edge would be short for what the input has there") {
    Scene s(drawn(straight({-2.5, -1.2}), kStraight));
    s.step.size.set(0, 2.5);
    CHECK(s.refuses([&] { return front::transition_split(s.step, s.at(1, 0), 0) != kNone; }));
  }
}
