// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes leave the triangles of a surface for what these stand for, and come back where an element would suffer.
#include "space/move_nodes.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "qmorph/check.hpp"
#include "qmorph/convert.hpp"
#include "space/surfaces.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;

/// A third of a cylinder of radius 1, converted: its nodes lie on the chords.
struct Converted {
  Patch patch = cylinder({.across = 10, .along = 12, .jitter = 0.2}, 1.0 / 3);
  QuadMesh mesh = convert(patch).mesh;
};

Vector3d on_cylinder(const Vector3d& p) {
  const double radius = std::hypot(p.x(), p.y());
  return {p.x() / radius, p.y() / radius, p.z()};
}

TEST_CASE("move nodes: inner nodes that are not the input's all go to where they belong, and no others") {
  Converted surface;
  const QuadMesh before = surface.mesh;
  const space::Result result(surface.patch, surface.mesh);
  const std::vector<Index> nodes = space::movable_nodes(result, surface.patch);
  REQUIRE(nodes.size() > 20);
  std::vector<space::Move> moves;
  for (const Index v : nodes) moves.push_back({v, on_cylinder(surface.mesh.points[v])});
  CHECK(space::move_nodes(result, moves, surface.mesh).empty());
  for (Index v = 0; v < surface.mesh.points.size(); ++v) {
    const bool moved = std::binary_search(nodes.begin(), nodes.end(), v);
    CHECK((surface.mesh.points[v] == (moved ? on_cylinder(before.points[v]) : before.points[v])));
    // All of them lie on the cylinder then: those that stay were there before.
    CHECK(std::abs(std::hypot(surface.mesh.points[v].x(), surface.mesh.points[v].y()) - 1) < 1e-12);
  }
  CHECK(find_defect(surface.patch, surface.mesh, InputQuads::kept, 1).has_value() == false);
  CHECK(find_defect(surface.patch, surface.mesh).has_value());  // they have left the triangles
}

TEST_CASE("move nodes: a node that would turn elements over stays, and the others move") {
  Converted surface;
  const QuadMesh before = surface.mesh;
  const space::Result result(surface.patch, surface.mesh);
  std::vector<space::Move> moves;
  for (const Index v : space::movable_nodes(result, surface.patch))
    moves.push_back({v, on_cylinder(surface.mesh.points[v])});
  const Index astray = moves[moves.size() / 2].node;
  moves[moves.size() / 2].to += Vector3d(0, 0, 0.5);  // several elements away
  const std::vector<Index> stayed = space::move_nodes(result, moves, surface.mesh);
  CHECK(std::binary_search(stayed.begin(), stayed.end(), astray));
  CHECK(stayed.size() < 12);  // it, and some of its neighbours at most
  CHECK((surface.mesh.points[astray] == before.points[astray]));
  for (const Index v : stayed) CHECK((surface.mesh.points[v] == before.points[v]));
  CHECK(find_defect(surface.patch, surface.mesh, InputQuads::kept, 1).has_value() == false);
}

}  // namespace
