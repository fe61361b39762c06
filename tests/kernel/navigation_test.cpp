// SPDX-License-Identifier: GPL-2.0-or-later
// Going round nodes and faces, and numbers that are not mixed up.
#include <doctest/doctest.h>

#include <type_traits>
#include <vector>

#include "kernel/mesh.hpp"

using namespace qmorph;
using namespace qmorph::kernel;

namespace {

/// Four triangles around node 4, in a square with the corners 0 to 3.
Mesh fan_of_four() {
  const std::vector<Vec2> points{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}};
  return {points, std::vector<std::array<Index, 3>>{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

std::vector<Index> targets(const Mesh& mesh, const auto& half_edges) {
  std::vector<Index> nodes;
  for (HalfEdgeId h : half_edges) nodes.push_back(mesh.target(h));
  return nodes;
}

}  // namespace

TEST_CASE("navigation: around a node each edge comes once, counter-clockwise") {
  const Mesh mesh = fan_of_four();
  std::vector<Index> around = targets(mesh, mesh.around(4));
  REQUIRE(around.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(around[(i + 1) % 4] == (around[i] + 1) % 4);
  CHECK(targets(mesh, mesh.around_from(mesh.find(4, 2))) == std::vector<Index>{2, 3, 0, 1});
}

TEST_CASE("navigation: at a boundary node the outside comes first, or the inside lies between the two ends") {
  const Mesh mesh = fan_of_four();
  CHECK(mesh.face(*mesh.around(0).begin()) == kNone);
  CHECK(targets(mesh, mesh.around(0)) == std::vector<Index>{3, 1, 4});
  CHECK(targets(mesh, mesh.around_inside(0)) == std::vector<Index>{1, 4, 3});
}

TEST_CASE("navigation: sides of a face, and of the outside") {
  const Mesh mesh = fan_of_four();
  std::vector<Index> sides = targets(mesh, mesh.sides_of(2));
  CHECK(sides == std::vector<Index>{3, 4, 2});
  CHECK(targets(mesh, mesh.loop_from(mesh.out(0))) == std::vector<Index>{3, 2, 1, 0});
}

TEST_CASE("navigation: the number of a node is not taken for one of a face") {
  static_assert(!std::is_constructible_v<AnyFace, NodeId>);
  static_assert(!std::is_constructible_v<AnyHalfEdge, FaceId>);
  static_assert(!std::is_constructible_v<AnyNode, AnyHalfEdge>);
  static_assert(std::is_convertible_v<NodeId, AnyNode> && std::is_convertible_v<NodeId, Index>);
  static_assert(!std::is_convertible_v<Index, NodeId>);
  CHECK(NodeId() == kNone);
  CHECK(sizeof(HalfEdgeId) == sizeof(Index));
}
