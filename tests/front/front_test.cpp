// SPDX-License-Identifier: GPL-2.0-or-later
// What is on the front, what follows what, angles, states and the queue.
#include <doctest/doctest.h>

#include <set>

#include "front/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// 6---7---8
/// | / | / |        Cells of quads where `quads` says so, else rising diagonals.
/// 3---4---5
/// | / | / |
/// 0---1---2
Mesh cells(std::array<bool, 4> quads) {
  Mesh mesh = grid(2, 2, Diagonals::rising);
  const Edges diagonals = {{0, 4}, {1, 5}, {3, 7}, {4, 8}};
  for (std::size_t i = 0; i < 4; ++i)
    if (quads[i]) mesh.join_faces(edge(mesh, diagonals[i].first, diagonals[i].second));
  return mesh;
}

}  // namespace

TEST_CASE("front: at the start it is the boundary, as half-edges with triangles on their left") {
  const Scene s(cells({}));
  CHECK(s.loop_nodes(s.at(0, 1)) == std::vector<Index>{0, 1, 2, 5, 8, 7, 6, 3});
  CHECK_FALSE(s.front.contains(s.at(1, 0)));
  CHECK_FALSE(s.front.contains(s.at(1, 4)));
}

TEST_CASE("front: behind a quad it goes around the quad") {
  const Scene s(cells({true, false, false, false}));
  CHECK(s.loop_nodes(s.at(1, 2)) == std::vector<Index>{1, 2, 5, 8, 7, 6, 3, 4});
  CHECK(s.front.contains(s.at(4, 1)));
  CHECK(s.front.contains(s.at(3, 4)));
  CHECK_FALSE(s.front.contains(s.at(0, 1)));
}

TEST_CASE("front: next and prev are inverse on every edge of random meshes, and loops are disjoint") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    for (int i = 0; i < 20; ++i) {  // quads here and there make the front wind and touch itself
      const auto h = Index(rng.below(mesh.half_edge_slots()));
      if (mesh.can_flip(h)) mesh.join_faces(h);
    }
    const Scene s(std::move(mesh));
    std::size_t edges = 0, in_loops = 0;
    std::set<Index> seen;
    for (Index h = 0; h < s.mesh.half_edge_slots(); ++h) {
      if (!s.mesh.is_live_half_edge(h) || !s.front.contains(h)) continue;
      ++edges;
      REQUIRE(s.front.contains(s.front.next(h)));
      REQUIRE(s.front.prev(s.front.next(h)) == h);
      REQUIRE(s.front.next(s.front.prev(h)) == h);
      REQUIRE(s.mesh.origin(s.front.next(h)) == s.mesh.target(h));
      if (!seen.contains(h))
        for (Index e : s.loop(h)) {
          REQUIRE(seen.insert(e).second);
          ++in_loops;
        }
    }
    REQUIRE(edges == in_loops);
  }
}

TEST_CASE("front: the wedges at the nodes of random meshes are the pairs of successive edges, each once") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    for (int i = 0; i < 20; ++i) {
      const auto h = Index(rng.below(mesh.half_edge_slots()));
      if (mesh.can_flip(h)) mesh.join_faces(h);
    }
    const Scene s(std::move(mesh));
    std::multiset<std::pair<Index, Index>> expected, found;
    for (Index h = 0; h < s.mesh.half_edge_slots(); ++h)
      if (s.mesh.is_live_half_edge(h) && s.front.contains(h)) expected.emplace(h, s.front.next(h));
    for (Index v = 0; v < s.mesh.vertex_slots(); ++v)
      if (s.mesh.is_live_vertex(v))
        s.front.for_wedges_at(v, [&](Index in, Index out) {
          CHECK(s.mesh.target(in) == v);
          found.emplace(in, out);
        });
    CHECK(found == expected);
  }
}

TEST_CASE("front: where loops touch, a node has four front edges and each loop keeps to its own triangles") {
  //   6---7---8
  //   |   | / |      quads at the lower right and the upper left
  //   3---4---5
  //   | / |   |
  //   0---1---2
  const Scene s(cells({false, true, true, false}));
  CHECK(s.loop_nodes(s.at(0, 1)) == std::vector<Index>{0, 1, 4, 3});
  CHECK(s.loop_nodes(s.at(4, 5)) == std::vector<Index>{4, 5, 8, 7});
}

TEST_CASE("front: angles are measured through the triangles ahead") {
  const Scene s(cells({true, false, false, false}));
  const auto left = [&](Index a, Index b) { return s.front.angle_left(s.at(a, b)) / kPi; };
  CHECK(left(2, 5) == doctest::Approx(0.5));  // corner
  CHECK(left(1, 2) == doctest::Approx(0.5));  // beside the quad
  CHECK(left(5, 8) == doctest::Approx(1.0));  // straight on
  CHECK(left(4, 1) == doctest::Approx(1.5));  // around the quad's corner
  CHECK(s.front.angle_right(s.at(3, 4)) == s.front.angle_left(s.at(4, 1)));
}

TEST_CASE("front: at the tip of a slit the angle is the whole circle, at its mouth a right angle each") {
  //   6---7---8
  //   | / | / |
  //   3===4---5        4-3 on the lower side, 9-4 on the upper
  //   | / | / |
  //   0---1---2
  std::vector<Vec2> points;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) points.emplace_back(x, y);
  points.emplace_back(0, 1);
  const Scene s(Mesh(points, {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {9, 4, 7}, {9, 7, 6}, {4, 5, 8}, {4, 8, 7}}));
  CHECK(s.loop_nodes(s.at(0, 1)) == std::vector<Index>{0, 1, 2, 5, 8, 7, 6, 9, 4, 3});
  CHECK(s.front.angle_left(s.at(4, 3)) == 2 * kPi);
  CHECK_FALSE(s.front.state(s.at(4, 3)).left);
  CHECK_FALSE(s.front.state(s.at(9, 4)).right);
  CHECK(s.front.angle_left(s.at(9, 4)) == doctest::Approx(kPi / 2));
  CHECK(s.front.state(s.at(9, 4)).left);
}

TEST_CASE("front: an end of an edge is a corner below 3 pi / 4") {
  // A fan at node 1: the angle between 1-2 and 1-0 is given.
  const struct {
    double angle;
    bool corner;
  } kCases[] = {{0.74 * kPi, true}, {0.76 * kPi, false}, {0.1 * kPi, true},
                {1.0 * kPi, false}, {1.2 * kPi, false},  {1.9 * kPi, false}};
  for (const auto& the_case : kCases) {
    const double angle = the_case.angle;
    CAPTURE(angle);
    const Vec2 middle = rotated(Vec2(1, 0), angle / 2);
    const Scene s(drawn({rotated(Vec2(1, 0), angle), {0, 0}, {1, 0}, middle}, {{1, 2, 3}, {1, 3, 0}}));
    CHECK(s.front.angle_left(s.at(1, 2)) == doctest::Approx(angle));
    CHECK(s.front.state(s.at(1, 2)).left == the_case.corner);
    CHECK(s.front.state(s.at(0, 1)).right == the_case.corner);
  }
  const Scene square(drawn({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}));
  CHECK(square.front.state(square.at(0, 1)).corners() == 2);
}

TEST_CASE("front: the queue returns the lowest level first, then most corners, then the shortest") {
  //   8---9--10--11       a strip 4 x 2 with one short boundary edge, 1-2
  //   4---5---6---7
  //   0---1-2-----3
  Mesh mesh = grid(3, 2, Diagonals::rising);
  mesh.set_point(2, {1.5, 0});
  mesh.set_point(6, {1.8, 1});
  Scene s(std::move(mesh));
  SUBCASE("a short edge before long ones") {
    for (Index h : s.loop(s.at(0, 1))) s.front.push(h);
    // Edges with one corner are those at the four corners of the strip.
    std::vector<int> corners;
    std::vector<double> lengths;
    for (Index h; (h = s.front.pop()) != kNone;) {
      corners.push_back(s.front.state(h).corners());
      lengths.push_back(s.mesh.length(h));
    }
    CHECK(corners == std::vector<int>{1, 1, 1, 1, 1, 1, 1, 1, 0, 0});
    CHECK(std::is_sorted(lengths.begin(), lengths.begin() + 8));
    CHECK(lengths[8] == 0.5);
  }
  SUBCASE("a level more comes later, whatever the state") {
    s.front.set_level(s.at(0, 1), 1);
    s.front.push(s.at(0, 1));
    s.front.push(s.at(1, 2));
    CHECK(s.front.pop() == s.at(1, 2));
    CHECK(s.front.pop() == s.at(0, 1));
    CHECK(s.front.pop() == kNone);
  }
  SUBCASE("pushed twice, an edge comes once, as it was pushed last") {
    s.front.push(s.at(1, 2), true);
    CHECK(s.front.pop() == s.at(1, 2));
    CHECK(s.front.was_forced());
    s.front.push(s.at(1, 2), true);
    s.front.push(s.at(1, 2));
    CHECK(s.front.pop() == s.at(1, 2));
    CHECK_FALSE(s.front.was_forced());
    CHECK(s.front.pop() == kNone);
  }
  SUBCASE("forced comes before corners") {
    s.front.push(s.at(0, 1));
    s.front.push(s.at(1, 2), true);
    CHECK(s.front.pop() == s.at(1, 2));
  }
  SUBCASE("an edge that left the front is not given") {
    s.front.push(s.at(0, 1));
    s.front.push(s.at(4, 0));
    s.mesh.join_faces(s.at(0, 5));
    CHECK(s.front.pop() == kNone);
  }
}

TEST_CASE("front: a rollback restores levels") {
  Scene s(cells({}));
  s.front.set_level(s.at(0, 1), 2);
  const Index h = s.at(0, 1);
  CHECK(s.refuses([&] {
    s.front.set_level(h, 5);
    s.front.set_level(s.mesh.half_edge_slots() + 40, 7);  // a slot that was not there
    return false;
  }));
  CHECK(s.front.level(h) == 2);
  CHECK(s.front.level(s.mesh.half_edge_slots() + 40) == 0);
}
