// SPDX-License-Identifier: GPL-2.0-or-later
// All ways to fill a small ring with quads: how many there are is known, and each can be drawn.
#include "cleanup/quadrangulations.hpp"

#include <doctest/doctest.h>

#include <set>

#include "cleanup/rings.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using cleanup::find_quadrangulations;
using cleanup::Quadrangulation;
using cleanup::RingNode;
using cleanup::SearchLimits;

std::vector<RingNode> ring_of(const Mesh& mesh, int n, int ideal) {
  std::vector<RingNode> ring;
  for (int i = 0; i < n; ++i) ring.push_back({2, ideal, 2, 63, mesh.point(Index(i)), true});
  return ring;
}

constexpr SearchLimits kAll{.most_cost = 1000, .most_inner = 0, .most_found = 1000, .most_steps = 1'000'000};

std::vector<Quadrangulation> all_of(int n, int most_inner, int ideal = 3) {
  SearchLimits limits = kAll;
  limits.most_inner = most_inner;
  std::size_t steps = 0;
  return find_quadrangulations(ring_of(polygon(std::vector<int>(std::size_t(n), 1)), n, ideal), limits, steps);
}

/// Filled; throws if that is not possible.
Mesh drawn_in_polygon(int n, const Quadrangulation& quadrangulation) {
  Mesh mesh = polygon(std::vector<int>(std::size_t(n), 1));
  std::vector<Index> outline, faces, nodes;
  for (Index i = 0; i < Index(n); ++i) outline.push_back(i);
  for (Index f = 0; f < mesh.face_slots(); ++f) faces.push_back(f);
  if (!cleanup::fill(mesh, ring_through(mesh, outline), faces, quadrangulation, nodes))
    throw std::logic_error("it cannot be drawn");
  return mesh;
}

}  // namespace

TEST_CASE("quadrangulations: without nodes inside there are as many as diagonals allow, each another") {
  // (3 q)! / (q! (2 q + 1)!) for q quads, Fuss and Catalan.
  for (const auto& known : {std::pair{4, 1}, {6, 3}, {8, 12}, {10, 55}}) {
    const int n = known.first, count = known.second;
    CAPTURE(n);
    const auto found = all_of(n, 0);
    CHECK(int(found.size()) == count);
    std::set<std::uint64_t> meshes;
    for (const Quadrangulation& q : found) {
      const Mesh mesh = drawn_in_polygon(n, q);
      CHECK(kernel::find_defects(mesh, false).empty());
      for (Index f = 0; f < mesh.face_slots(); ++f) CHECK((!mesh.is_live_face(f) || mesh.is_quad(f)));
      meshes.insert(topology::connectivity(mesh));
    }
    CHECK(int(meshes.size()) == count);
  }
}

TEST_CASE("quadrangulations: a node inside has three to five edges, and the cost is what its mesh has") {
  // A hexagon: three without a node, and two with one in the middle.
  CHECK(all_of(6, 1).size() == 3 + 2);
  CHECK(all_of(4, 1).size() == 1);
  for (const int n : {6, 8, 10})
    for (const Quadrangulation& q : all_of(n, 3)) {
      const Mesh mesh = drawn_in_polygon(n, q);
      int cost = 0;
      for (Index v = 0; v < mesh.vertex_slots(); ++v) {
        if (!mesh.is_live_vertex(v)) continue;
        const int edges = int(mesh.valence(v)), excess = edges - (mesh.is_boundary(v) ? 3 : 4);
        CHECK((mesh.is_boundary(v) || (edges >= 3 && edges <= 5)));
        cost += excess * excess;
      }
      CHECK(cost == q.cost);
    }
}

TEST_CASE("quadrangulations: the cheapest come first, and are the same if fewer are asked for") {
  const auto all = all_of(12, 2);
  SearchLimits limits = kAll;
  limits.most_inner = 2, limits.most_found = 5;
  std::size_t steps = 0;
  const auto few = find_quadrangulations(ring_of(polygon(std::vector<int>(12, 1)), 12, 3), limits, steps);
  REQUIRE(few.size() == 5);
  for (std::size_t i = 0; i < few.size(); ++i) CHECK(few[i].cost == all[i].cost);
  for (std::size_t i = 1; i < all.size(); ++i) CHECK(all[i - 1].cost <= all[i].cost);
  limits.most_steps = 10, steps = 0;
  find_quadrangulations(ring_of(polygon(std::vector<int>(12, 1)), 12, 3), limits, steps);
  CHECK(steps <= 10);
}

TEST_CASE("quadrangulations: corners between nodes of the ring are convex, and good where these do not move") {
  // An L of three squares: only its reflex corner may be cut.
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1}};
  std::vector<RingNode> ring;
  for (const Vec2& p : points) ring.push_back({2, 3, 2, 63, p, false});
  std::size_t steps = 0;
  const auto found = find_quadrangulations(ring, kAll, steps);
  REQUIRE(found.size() == 1);
  CHECK(found[0].steps.size() == 3);
  SearchLimits strict = kAll;
  strict.least_sine = 1;  // squares do not have more
  CHECK(find_quadrangulations(ring, strict, steps).empty());
}
