// SPDX-License-Identifier: GPL-2.0-or-later
// Parity of front loops by colours, against counting.
#include <doctest/doctest.h>

#include <map>

#include "front/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// One half-edge of each front loop.
std::vector<Index> loops_of(const Scene& s) {
  std::vector<Index> loops;
  std::vector<bool> seen(s.mesh.half_edge_slots(), false);
  for (Index h = 0; h < s.mesh.half_edge_slots(); ++h) {
    if (!s.mesh.is_live_half_edge(h) || !s.front.contains(h) || seen[h]) continue;
    loops.push_back(h);
    for (Index e : s.loop(h)) seen[e] = true;
  }
  return loops;
}

/// Front edges whose ends have the same colour.
int unfit_edges(const Scene& s) {
  int unfit = 0;
  for (Index loop : loops_of(s))
    for (Index h : s.loop(loop)) unfit += !s.colours.may_join(s.mesh.origin(h), s.mesh.target(h));
  return unfit;
}

}  // namespace

TEST_CASE("colours: on an even loop a new edge is allowed exactly if it leaves two even loops") {
  // A polygon of n sides around a centre; the front is its boundary.
  for (const Index n : {4u, 6u, 8u, 14u}) {
    CAPTURE(n);
    std::vector<Vec2> points;
    Polygons fan;
    for (Index i = 0; i < n; ++i) {
      points.push_back(rotated(Vec2(1, 0), 2 * kPi * i / n));
      fan.push_back({i, (i + 1) % n, n});
    }
    points.emplace_back(0, 0);
    const Scene s(drawn(points, fan));
    CHECK_FALSE(s.colours.is_coloured(n));
    for (Index a = 0; a < n; ++a) {
      CHECK(s.colours.may_join(a, n));  // no colour: nothing is closed there
      for (Index b = a + 1; b < n; ++b) CHECK(s.colours.may_join(a, b) == ((b - a + 1) % 2 == 0));
    }
  }
}

TEST_CASE("colours: on random meshes with holes, separate loops may always be joined") {
  int pairs = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    const Scene s(random_mesh(rng));
    std::map<Index, std::pair<std::size_t, std::size_t>> place;  // node: loop, position
    const auto loops = loops_of(s);
    for (std::size_t l = 0; l < loops.size(); ++l) {
      const auto nodes = s.loop_nodes(loops[l]);
      REQUIRE(nodes.size() % 2 == 0);
      for (std::size_t i = 0; i < nodes.size(); ++i) place[nodes[i]] = {l, i};
    }
    for (const auto& [a, p] : place)
      for (const auto& [b, q] : place) {
        if (a == b) continue;
        REQUIRE(s.colours.may_join(a, b) == (p.first != q.first || (p.second + q.second) % 2 == 1));
        ++pairs;
      }
  }
  CHECK(pairs > 10000);
}

TEST_CASE("colours: even loops that were joined are one system, in any order of joining") {
  // The law, counted: with edge a-b between two loops, an edge c-d closes the walk c ... a, b ... d, c.
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    const auto columns = Index(9), rows = Index(9);
    Scene s(grid(columns, rows, Diagonals::random, rng, [](Index x, Index y) { return x % 2 == 1 && y % 2 == 1; }));
    const auto loops = loops_of(s);
    REQUIRE(loops.size() == 17);
    std::vector<std::vector<Index>> nodes;
    for (Index h : loops) nodes.push_back(s.loop_nodes(h));
    // Distances from the first node of each loop's group, found by walking over what was joined.
    std::map<Index, int> parity, group;
    for (std::size_t l = 0; l < nodes.size(); ++l)
      for (std::size_t i = 0; i < nodes[l].size(); ++i) parity[nodes[l][i]] = int(i % 2), group[nodes[l][i]] = int(l);
    for (int i = 0; i < 14; ++i) {
      const Index a = rng.pick(nodes[rng.below(nodes.size())]), b = rng.pick(nodes[rng.below(nodes.size())]);
      if (a == b || !s.colours.may_join(a, b)) continue;
      s.colours.join(a, b, loops[0]);
      if (group[a] == group[b]) continue;
      const int from = group[b], to = group[a], shift = parity[b] == parity[a] ? 1 : 0;
      for (auto& [node, g] : group)
        if (g == from) g = to, parity[node] ^= shift;
    }
    for (const auto& [c, g] : group)
      for (const auto& [d, other] : group)
        if (c != d) REQUIRE(s.colours.may_join(c, d) == (g != other || parity[c] != parity[d]));
  }
}

TEST_CASE("colours: an odd loop has exactly one edge whose ends have the same colour") {
  for (const Index n : {3u, 5u, 9u}) {
    const Scene s(annulus(n));
    CHECK(unfit_edges(s) == 2);  // one in each of the two loops
  }
  const Scene even(annulus(6));
  CHECK(unfit_edges(even) == 0);
}

TEST_CASE("colours: two odd loops that meet become one even loop, coloured anew") {
  for (const Index n : {3u, 5u, 7u}) {
    CAPTURE(n);
    Scene s(annulus(n));
    // The quad of outer nodes 0, 1 and inner nodes n, n + 1 cuts the ring open: the front is one loop.
    s.mesh.join_faces(s.at(0, n + 1));
    const Index along = s.at(1, 2);
    REQUIRE(s.loop(along).size() == 2 * n);
    s.colours.join(1, n + 1, along);
    CHECK(unfit_edges(s) == 0);
  }
}

TEST_CASE("colours: an odd loop that meets an even one makes an odd loop") {
  // Outer triangle, inner square: a ring of 3 + 4 triangles.
  const std::vector<Vec2> points = {{0, 4}, {-4, -3}, {4, -3}, {-1, -1}, {1, -1}, {1, 0.5}, {-1, 0.5}};
  Scene s(drawn(points, {{1, 2, 4}, {1, 4, 3}, {2, 5, 4}, {2, 0, 5}, {0, 6, 5}, {0, 1, 6}, {1, 3, 6}}));
  REQUIRE(defect(s.mesh) == "");
  CHECK(unfit_edges(s) == 1);
  s.mesh.join_faces(s.at(1, 4));
  s.colours.join(1, 3, s.at(2, 0));
  CHECK(s.loop(s.at(2, 0)).size() == 7);
  CHECK(unfit_edges(s) == 1);
}

TEST_CASE("colours: a new node gets the colour opposite to the other end's, or the same, and loses it again") {
  Scene s(annulus(4));
  s.colours.colour_opposite(20, 1);
  CHECK(s.colours.may_join(20, 1));
  CHECK_FALSE(s.colours.may_join(20, 2));
  s.colours.colour_same(21, 20);
  CHECK_FALSE(s.colours.may_join(21, 20));
  CHECK(s.colours.may_join(21, 1));
  s.colours.forget(21);
  CHECK_FALSE(s.colours.is_coloured(21));
}

TEST_CASE("colours: a rollback restores colours") {
  Scene s(annulus(4));
  CHECK(s.refuses([&] {
    s.colours.colour_same(1, 2);
    s.colours.colour_same(30, 2);
    s.colours.forget(3);
    return false;
  }));
  CHECK(s.colours.may_join(1, 2));
  CHECK_FALSE(s.colours.is_coloured(30));
  CHECK(s.colours.is_coloured(3));
}
