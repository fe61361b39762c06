// SPDX-License-Identifier: GPL-2.0-or-later
// The worst corners rise, and no corner falls under what the worst was.
#include "smoothing/corner_energy.hpp"

#include <doctest/doctest.h>

#include "cleanup/rings.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using smoothing::raise_worst_corners;

/// Quads whose nodes, boundary too, are off the grid; valid.
Mesh jittered_quads(Rng& rng) {
  Mesh mesh = quad_grid(Index(rng.range(3, 8)), Index(rng.range(3, 8)));
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    mesh.set_point(v, mesh.point(v) + Vec2(rng.between(-0.24, 0.24), rng.between(-0.24, 0.24)));
  return mesh;
}

}  // namespace

TEST_CASE("raise corners: a node that was pushed aside comes back, and the worst corner is then a good one") {
  Mesh mesh = quad_grid(4, 4);
  mesh.set_point(12, Vec2(2.45, 2.4));
  REQUIRE(topology::smallest_sine(mesh) < 0.5);
  raise_worst_corners(mesh, {});
  CHECK(topology::smallest_sine(mesh) > 0.75);
}

TEST_CASE("raise corners: in any mesh the smallest sine rises or stays, and boundary and fixed nodes stay") {
  int raised = 0;
  constexpr int kMeshes = 60;
  for (int seed = 0; seed < kMeshes; ++seed) {
    CAPTURE(seed);
    Rng rng{std::uint64_t(seed)};
    Mesh mesh = jittered_quads(rng);
    if (seed % 2 == 0) smoothing::smooth(mesh, {});
    for (Index v = 0; v < mesh.vertex_slots(); v += 7) mesh.set_fixed(v);
    const Mesh start = mesh;
    raise_worst_corners(mesh, {});
    CHECK(topology::smallest_sine(mesh) >= topology::smallest_sine(start));
    raised += topology::smallest_sine(mesh) > topology::smallest_sine(start) + 1e-3;
    CHECK(defect(mesh) == "");
    CHECK(faces_of(mesh) == faces_of(start));
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      if (!start.is_free(v)) CHECK(mesh.point(v) == start.point(v));
  }
  CHECK(raised > kMeshes / 4);
}

TEST_CASE("raise corners: good corners stay as they are, to the bit") {
  Mesh mesh = quad_grid(5, 5);
  mesh.set_point(14, mesh.point(14) + Vec2(0.1, 0.05));
  const Snapshot before = snapshot(mesh);
  SmoothingOptions options;
  raise_worst_corners(mesh, options);
  CHECK(snapshot(mesh) == before);
  options.good_quality = 0.999;
  raise_worst_corners(mesh, options);
  CHECK_FALSE(snapshot(mesh) == before);
}

TEST_CASE("raise corners: an inverted element makes no node move to where others get worse") {
  Mesh mesh = quad_grid(4, 4);
  mesh.set_point(12, Vec2(3.4, 2.2));
  const double before = topology::smallest_sine(mesh);
  REQUIRE(before < 0);
  raise_worst_corners(mesh, {});
  CHECK(topology::smallest_sine(mesh) >= before);
}

TEST_CASE("raise corners: at the mouth of a channel that is far narrower than quads are long corners rise, too") {
  constexpr double kHalf = 0.0167;  // of its width
  const std::vector<Vec2> points = {{0, kHalf},    {-0.018, 0},    {0, -kHalf}, {-0.5, 0.87},  {-0.5, -0.87},
                                    {-0.42, 0.39}, {-0.41, -0.33}, {-0.81, 0},  {-1.24, 0.73}, {-1.24, -0.6},
                                    {1, kHalf},    {1.02, 0},      {1, -kHalf}};
  const std::vector<std::array<Index, 4>> quads = {{0, 3, 5, 1}, {1, 5, 7, 6},   {1, 6, 4, 2},  {3, 8, 7, 5},
                                                   {4, 6, 7, 9}, {1, 2, 12, 11}, {1, 11, 10, 0}};
  Mesh mesh(points, quads, {});
  REQUIRE(defect(mesh) == "");
  REQUIRE(topology::smallest_sine(mesh) < 0.37);
  raise_worst_corners(mesh, {});
  CHECK(topology::smallest_sine(mesh) > 0.45);
}
