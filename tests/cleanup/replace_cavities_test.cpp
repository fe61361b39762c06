// SPDX-License-Identifier: GPL-2.0-or-later
// Irregular nodes that cancel each other vanish, the boundary stays.
#include "cleanup/replace_cavities.hpp"

#include <doctest/doctest.h>

#include <array>

#include "cleanup/rings.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using cleanup::replace_cavities;

/// A grid of 12 x 12 cells, of which a block of 4 x 4 is three grids around a node: nodes of three and five edges
/// around it.
Mesh grid_with_star() {
  Mesh mesh = grid_with_block(12, 12, 4, 4, 4, {0, 5, 11});
  smoothing::smooth(mesh, {});
  return mesh;
}

/// A grid of which the edge between two cells runs the other way: two nodes with three edges, two with five.
Mesh grid_with_turned_edge(Index cells) {
  Mesh mesh = grid_with_block(cells, cells, cells / 2 - 1, 2, 1, {1, 2, 4, 5});
  smoothing::smooth(mesh, {});
  return mesh;
}

std::vector<Vec2> boundary_points(const Mesh& mesh) {
  std::vector<Vec2> points;
  for (const auto& [a, b] : boundary_of(mesh)) points.push_back(mesh.point(a));
  return points;
}

/// Fixes a node far from the irregular ones, so that the whole region is no cavity.
Mesh with_fixed_node(Mesh mesh) {
  Index v = 0;
  while (!mesh.is_live_vertex(v) || mesh.is_boundary(v)) ++v;
  mesh.set_fixed(v);
  return mesh;
}

void check_that_all_vanish(Mesh mesh) {
  REQUIRE(irregular_nodes(mesh) >= 4);
  const Edges boundary = boundary_of(mesh);
  const std::vector<Vec2> points = boundary_points(mesh);
  CHECK(replace_cavities(mesh, {}) > 0);
  CHECK(irregular_nodes(mesh) == 0);
  CHECK(defect(mesh) == "");
  CHECK(boundary_of(mesh) == boundary);
  CHECK(boundary_points(mesh) == points);
  CHECK(count_quads(mesh) == count(mesh).faces);
}

}  // namespace

TEST_CASE("replace cavities: pairs of three and five edges in a grid vanish") {
  check_that_all_vanish(with_fixed_node(grid_with_turned_edge(8)));
}

TEST_CASE("replace cavities: three pairs around one block vanish together") {
  Mesh mesh = grid_with_block(12, 12, 4, 2, 3, {0, 2, 4, 6, 8});
  smoothing::smooth(mesh, {});
  check_that_all_vanish(with_fixed_node(mesh));
}

TEST_CASE("replace cavities: pairs that are far from each other meet") {
  // Two edges turned, 10 rows apart: the mesh has eight irregular nodes.
  Mesh mesh = quad_grid(24, 24);
  for (Index y : {7, 17}) {
    const auto node = [&](Index x, Index dy) { return (y + dy) * 25 + 12 + x; };
    const std::vector<Index> outline = {node(0, 0), node(1, 0), node(2, 0), node(2, 1), node(1, 1), node(0, 1)};
    const std::vector<Index> faces = {mesh.face(edge(mesh, node(0, 0), node(1, 0))),
                                      mesh.face(edge(mesh, node(1, 0), node(2, 0)))};
    std::vector<Index> nodes;
    REQUIRE(cleanup::fill(mesh, ring_through(mesh, outline), faces,
                          *cleanup::filling_between(std::array{1, 2, 4, 5}, 6), nodes));
  }
  smoothing::smooth(mesh, {});
  REQUIRE(irregular_nodes(mesh) == 8);
  check_that_all_vanish(with_fixed_node(mesh));
}

TEST_CASE("replace cavities: what no cavity inside can mend is mended if the whole region has a filling") {
  Mesh cavities_only = with_fixed_node(grid_with_star());
  replace_cavities(cavities_only, {});
  CHECK(irregular_nodes(cavities_only) < irregular_nodes(grid_with_star()));
  check_that_all_vanish(grid_with_star());
}

TEST_CASE("replace cavities: a grid stays as it is, to the bit") {
  Mesh mesh = quad_grid(6, 5);
  const Snapshot before = snapshot(mesh);
  CHECK(replace_cavities(mesh, {}) == 0);
  CHECK(snapshot(mesh) == before);
}

TEST_CASE("replace cavities: the one irregular node that a polygon of three or five sides needs stays") {
  for (const auto& sides : {std::vector<int>{6, 6, 6}, {6, 6, 6, 6, 6}}) {
    Mesh mesh = filled_polygon(sides);
    smoothing::smooth(mesh, {});
    replace_cavities(mesh, {});
    CHECK(irregular_nodes(mesh) == 1);
    CHECK(defect(mesh) == "");
  }
}

TEST_CASE("replace cavities: a fixed node stays where it is, even if it is irregular") {
  Mesh mesh = grid_with_turned_edge(8);
  std::vector<std::pair<Index, Vec2>> fixed;
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v) && !mesh.is_boundary(v) && mesh.valence(v) == 5) {
      mesh.set_fixed(v);
      fixed.emplace_back(v, mesh.point(v));
    }
  REQUIRE(fixed.size() == 2);
  replace_cavities(mesh, {});
  for (const auto& [v, p] : fixed) {
    REQUIRE(mesh.is_live_vertex(v));
    CHECK(mesh.point(v) == p);
  }
  CHECK(defect(mesh) == "");
}

TEST_CASE("replace cavities: the same mesh gives the same result twice") {
  Mesh a = grid_with_star(), b = grid_with_star();
  replace_cavities(a, {});
  replace_cavities(b, {});
  CHECK(snapshot(a) == snapshot(b));
}

TEST_CASE("poor cavities: where a quad is poor a filling raises the worst corner, and the boundary stays") {
  // The longer the cells, the sharper the corners at irregular nodes.
  Mesh mesh = with_fixed_node(grid_with_turned_edge(8));
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v)) mesh.set_point(v, {3 * mesh.point(v).x(), mesh.point(v).y()});
  const double before = topology::smallest_sine(mesh);
  REQUIRE(before < 0.55);
  const Edges boundary = boundary_of(mesh);
  const std::vector<Vec2> points = boundary_points(mesh);
  CHECK(cleanup::replace_poor_cavities(mesh, {}) > 0);
  CHECK(topology::smallest_sine(mesh) >= before + 0.05);
  CHECK(defect(mesh) == "");
  CHECK(boundary_of(mesh) == boundary);
  CHECK(boundary_points(mesh) == points);
}

TEST_CASE("poor cavities: without a poor quad nothing changes, whatever the valences") {
  Mesh mesh = grid_with_star();
  REQUIRE(topology::smallest_sine(mesh) > 0.6);
  const Snapshot before = snapshot(mesh);
  CHECK(cleanup::replace_poor_cavities(mesh, {}) == 0);
  CHECK(snapshot(mesh) == before);
}
