// SPDX-License-Identifier: GPL-2.0-or-later
// A mesh that is a grid gets the places of a grid.
#include "smoothing/grid.hpp"

#include <doctest/doctest.h>

#include "cleanup/rings.hpp"
#include "smoothing/smooth.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using smoothing::snap_to_grid;

void move_inner_nodes(Mesh& mesh, Rng& rng, double distance) {
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v) && !mesh.is_boundary(v))
      mesh.set_point(v, mesh.point(v) + Vec2(rng.between(-distance, distance), rng.between(-distance, distance)));
}

}  // namespace

TEST_CASE("snap to grid: a jittered grid becomes exact") {
  for (const auto& [columns, rows] : {std::pair<Index, Index>{8, 4}, {4, 8}, {2, 2}, {2, 7}}) {
    const Mesh exact = quad_grid(columns, rows);
    Mesh mesh = exact;
    Rng rng(columns);
    move_inner_nodes(mesh, rng, 0.3);
    REQUIRE(snap_to_grid(mesh));
    for (Index v = 0; v < mesh.vertex_slots(); ++v) {
      CHECK((mesh.point(v) - exact.point(v)).norm() < 1e-12);
      if (mesh.is_boundary(v)) CHECK(mesh.point(v) == exact.point(v));
    }
  }
}

TEST_CASE("snap to grid: lines follow sides that are graded or slanted") {
  // Columns get wider, rows are slanted: still a Coons patch of its sides.
  Mesh exact = quad_grid(6, 5);
  for (Index v = 0; v < exact.vertex_slots(); ++v) {
    const Vec2 p = exact.point(v);
    exact.set_point(v, Vec2(p.x() * (1 + 0.1 * p.x()), p.y() + 0.2 * p.x()));
  }
  Mesh mesh = exact;
  Rng rng(1);
  move_inner_nodes(mesh, rng, 0.25);
  REQUIRE(snap_to_grid(mesh));
  for (Index v = 0; v < mesh.vertex_slots(); ++v) CHECK((mesh.point(v) - exact.point(v)).norm() < 1e-12);
}

TEST_CASE("snap to grid: a mesh that is no grid is left alone, to the bit") {
  Mesh triangle_inside = quad_grid(4, 4);
  const Index h = edge(triangle_inside, 6, 7);
  triangle_inside.split_face(h, triangle_inside.next(triangle_inside.next(h)));
  Mesh fixed_inside = quad_grid(4, 4);
  fixed_inside.set_fixed(12);
  for (const Mesh& start :
       {filled_polygon({4, 4, 4}), filled_polygon({4, 4, 4, 4, 4}), grid_with_block(8, 8, 3, 2, 1, {1, 2, 4, 5}),
        triangle_inside, fixed_inside, quad_grid(5, 1)}) {
    Mesh mesh = start;
    CHECK_FALSE(snap_to_grid(mesh));
    CHECK(snapshot(mesh) == snapshot(start));
  }
}

TEST_CASE("snap to grid: where a notch in a side would be carried through all rows, smoothed nodes stay as they are") {
  Mesh mesh = quad_grid(8, 4);
  mesh.set_point(4, Vec2(4, 0.6));
  smoothing::smooth(mesh, {});
  const Snapshot before = snapshot(mesh);
  CHECK_FALSE(snap_to_grid(mesh));
  CHECK(snapshot(mesh) == before);
}
