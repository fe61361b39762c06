// SPDX-License-Identifier: GPL-2.0-or-later
// What is around a poor quad is replaced by the best there is.
#include "cleanup/refill.hpp"

#include <doctest/doctest.h>

#include "cleanup/rings.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using cleanup::refill_around_poor;

/// Two quads in a hexagon that is nearly a rectangle, cut along a diagonal of it.
Mesh badly_cut() { return drawn({{0, 0}, {1, -0.1}, {2, 0}, {2, 1}, {1, 1.1}, {0, 1}}, {{0, 1, 2, 3}, {0, 3, 4, 5}}); }

}  // namespace

TEST_CASE("refill: two quads that are cut badly are cut well") {
  Mesh mesh = badly_cut();
  REQUIRE(topology::smallest_sine(mesh) < 0.2);
  REQUIRE(cleanup::has_poor_quads(mesh));
  CHECK(refill_around_poor(mesh, {}, {}) == 1);
  CHECK(topology::smallest_sine(mesh) > 0.98);
  CHECK_FALSE(cleanup::has_poor_quads(mesh));
  CHECK(defect(mesh) == "");
}

TEST_CASE("refill: what nothing better is found for stays, to the bit, and costs something; without a budget nothing") {
  // Its boundary leaves a rhombus no choice.
  Mesh mesh = drawn({{0, 0}, {1, 0}, {1.9, 0.4}, {0.9, 0.4}}, {{0, 1, 2, 3}});
  REQUIRE(cleanup::has_poor_quads(mesh));
  const Snapshot before = snapshot(mesh);
  CHECK(refill_around_poor(mesh, {}, {}) == 0);
  CHECK(snapshot(mesh) == before);
  CHECK(mesh.work() > 0);
  Mesh other = badly_cut();
  CHECK(refill_around_poor(other, {}, {other, 0}) == 0);
}

TEST_CASE("refill: in any mesh the worst corner rises or nothing changes, and boundary and fixed nodes stay") {
  int raised = 0;
  for (int seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Rng rng{std::uint64_t(seed)};
    Mesh mesh = quad_grid(Index(rng.range(3, 6)), Index(rng.range(3, 6)));
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      mesh.set_point(v, mesh.point(v) + Vec2(rng.between(-0.26, 0.26), rng.between(-0.26, 0.26)));
    for (Index v = 0; v < mesh.vertex_slots(); v += 5) mesh.set_fixed(v);
    const Mesh start = mesh;
    const std::size_t changes = refill_around_poor(mesh, {}, {});
    CHECK(defect(mesh) == "");
    CHECK(topology::smallest_sine(mesh) >= topology::smallest_sine(start));
    raised += changes > 0;
    for (Index v = 0; v < start.vertex_slots(); ++v)
      if (!start.is_free(v)) {
        REQUIRE(mesh.is_live_vertex(v));
        CHECK(mesh.point(v) == start.point(v));
      }
  }
  CHECK(raised > 0);
}
