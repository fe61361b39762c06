// SPDX-License-Identifier: GPL-2.0-or-later
// The front as a whole on small meshes.
#include <doctest/doctest.h>

#include "front/fixture.hpp"
#include "front/morph.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

}  // namespace

TEST_CASE("morph: a rectangle of n x m cells becomes a grid without irregular nodes") {
  for (const auto& size : std::vector<std::pair<Index, Index>>{
           {1, 1}, {2, 1}, {2, 2}, {3, 3}, {4, 2}, {4, 4}, {6, 4}, {8, 8}, {12, 6}, {20, 10}})
    for (const Diagonals diagonals : {Diagonals::rising, Diagonals::falling}) {
      const Index columns = size.first, rows = size.second;
      CAPTURE(columns);
      CAPTURE(rows);
      Mesh mesh = grid(columns, rows, diagonals);
      const Edges boundary = boundary_of(mesh);
      front::morph(mesh, {}, {.check_each_step = true});
      CHECK(count_quads(mesh) == int(columns * rows));
      CHECK(count_triangles(mesh) == 0);
      CHECK(irregular_nodes(mesh) == 0);
      CHECK(boundary_of(mesh) == boundary);
      CHECK(defect(mesh) == "");
    }
}

TEST_CASE("morph: on random meshes with holes every step leaves valid elements; boundary, area and fixed nodes stay") {
  std::size_t quads = 0, triangles = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mesh(rng);
    std::vector<Index> fixed;
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      if (mesh.is_live_vertex(v) && rng.chance(0.05)) mesh.set_fixed(v), fixed.push_back(v);
    const Mesh before = mesh;
    front::morph(mesh, {}, {.check_each_step = true});  // true: throws after the first step that leaves a defect
    REQUIRE(defect(mesh) == "");
    REQUIRE(boundary_of(mesh) == boundary_of(before));
    REQUIRE(area_of(mesh) == doctest::Approx(area_of(before)));
    for (const auto& [a, b] : boundary_of(mesh)) REQUIRE(mesh.point(a) == before.point(a));
    for (Index v : fixed) {
      REQUIRE(mesh.is_live_vertex(v));
      REQUIRE(mesh.point(v) == before.point(v));
    }
    quads += count_quads(mesh), triangles += count_triangles(mesh);
  }
  CHECK(triangles * 5 < quads);  // the front did the work
}

TEST_CASE("morph: the same mesh gives the same bits") {
  Rng rng(7);
  const Mesh start = random_mesh(rng);
  Mesh one = start, two = start;
  front::morph(one, {});
  front::morph(two, {});
  CHECK(snapshot(one) == snapshot(two));
}

TEST_CASE("morph: an odd loop leaves an odd number of triangles") {
  for (const Index n : {3u, 5u, 7u, 9u}) {
    std::vector<Vec2> outline;
    Polygons fan;
    for (Index i = 0; i < n; ++i) {
      outline.push_back(rotated(Vec2(1, 0), 2 * kPi * i / n));
      fan.push_back({i, (i + 1) % n, n});
    }
    outline.emplace_back(0.1, 0);
    Mesh mesh = drawn(outline, fan);
    front::morph(mesh, {}, {.check_each_step = true});
    CHECK(count_triangles(mesh) % 2 == 1);
    CHECK(boundary_of(mesh).size() == n);
    CHECK(defect(mesh) == "");
  }
}
