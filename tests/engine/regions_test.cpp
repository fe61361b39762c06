// SPDX-License-Identifier: GPL-2.0-or-later
// A surface is cut along its constraints into manifolds with boundary.
#include <doctest/doctest.h>

#include "engine/regions.hpp"
#include "kernel/fixture.hpp"
#include "qmorph/error.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// Node y * (columns + 1) + x at (x, y, 0), rising diagonals.
Patch plate(Index columns, Index rows) {
  Patch patch;
  for (Index y = 0; y <= rows; ++y)
    for (Index x = 0; x <= columns; ++x) patch.points.emplace_back(x, y, 0);
  for (Index y = 0; y < rows; ++y)
    for (Index x = 0; x < columns; ++x) {
      const Index a = y * (columns + 1) + x, b = a + 1, d = a + columns + 1, c = d + 1;
      patch.triangles.insert(patch.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  return patch;
}

std::vector<Region> cut(const Patch& patch) {
  std::vector<Vec2> flat;
  for (const auto& p : patch.points) flat.emplace_back(p.x(), p.y());
  return cut_into_regions(patch, flat);
}

/// The mesh of a region, which must be legal and have the boundary that the region says.
Mesh mesh_of(const Region& region) {
  Mesh mesh(region.points, region.triangles, region.open);
  CHECK(defect(mesh) == "");
  CHECK(boundary_of(mesh).size() == region.boundary_sides);
  return mesh;
}

/// How often a node of the patch is a vertex of the region.
int copies(const Region& region, Index node) { return int(std::count(region.node.begin(), region.node.end(), node)); }

}  // namespace

TEST_CASE("regions: without constraints there is one, the patch itself") {
  Patch patch = plate(3, 2);
  patch.fixed = {5};
  const auto regions = cut(patch);
  REQUIRE(regions.size() == 1);
  const Mesh mesh = mesh_of(regions[0]);
  CHECK(regions[0].boundary_sides == 10);
  CHECK(regions[0].points.size() == 12);
  CHECK(mesh.is_boundary(0));
  REQUIRE(regions[0].fixed.size() == 1);
  CHECK(regions[0].node[regions[0].fixed[0]] == 5);
  for (Index v = 0; v < 12; ++v) {
    CHECK(copies(regions[0], v) == 1);
    CHECK(regions[0].points[v] == Vec2(patch.points[regions[0].node[v]].head<2>()));
  }
}

TEST_CASE("regions: a constraint on the boundary changes nothing") {
  Patch patch = plate(2, 2);
  patch.constraints = {{0, 1}, {1, 2}, {5, 2}};
  const auto regions = cut(patch);
  REQUIRE(regions.size() == 1);
  CHECK(regions[0].points.size() == 9);
  CHECK(regions[0].boundary_sides == 8);
}

TEST_CASE("regions: a slit from the boundary has two sides and one tip") {
  //   8---9--10--11
  //   4===5---6---7       constraint 4-5
  //   0---1---2---3
  Patch patch = plate(3, 2);
  patch.constraints = {{4, 5}};
  const auto regions = cut(patch);
  REQUIRE(regions.size() == 1);
  CHECK(copies(regions[0], 4) == 2);
  CHECK(copies(regions[0], 5) == 1);
  CHECK(regions[0].boundary_sides == 12);
  mesh_of(regions[0]);
}

TEST_CASE("regions: a floating slit of two edges doubles its middle node, one of one edge none") {
  SUBCASE("two edges") {
    Patch patch = plate(4, 2);
    patch.constraints = {{6, 7}, {8, 7}};  // either direction
    const auto regions = cut(patch);
    REQUIRE(regions.size() == 1);
    CHECK(copies(regions[0], 6) == 1);
    CHECK(copies(regions[0], 7) == 2);
    CHECK(copies(regions[0], 8) == 1);
    CHECK(regions[0].boundary_sides == 12 + 4);
    mesh_of(regions[0]);
  }
  SUBCASE("one edge") {
    Patch patch = plate(3, 3);
    patch.constraints = {{5, 6}};
    const auto regions = cut(patch);
    REQUIRE(regions.size() == 1);
    CHECK(regions[0].points.size() == 16);
    CHECK(regions[0].boundary_sides == 12 + 2);
    const Mesh mesh = mesh_of(regions[0]);
    CHECK(count(mesh).euler() == 0);  // the slit is a hole without area
    const auto vertex = [&](Index node) {
      return Index(std::find(regions[0].node.begin(), regions[0].node.end(), node) - regions[0].node.begin());
    };
    CHECK(mesh.is_boundary(vertex(5)));
    CHECK(mesh.is_boundary(vertex(6)));
    CHECK_FALSE(mesh.is_boundary(vertex(9)));
  }
}

TEST_CASE("regions: a cross of constraints has a node with four fans") {
  Patch patch = plate(4, 4);
  patch.constraints = {{11, 12}, {12, 13}, {7, 12}, {12, 17}};
  const auto regions = cut(patch);
  REQUIRE(regions.size() == 1);
  CHECK(copies(regions[0], 12) == 4);
  CHECK(regions[0].boundary_sides == 16 + 8);
  mesh_of(regions[0]);
}

TEST_CASE("regions: an embedded closed line separates inside from outside") {
  Patch patch = plate(4, 4);
  patch.constraints = {{6, 7}, {7, 8}, {8, 13}, {13, 18}, {18, 17}, {17, 16}, {16, 11}, {11, 6}};
  const auto regions = cut(patch);
  REQUIRE(regions.size() == 2);
  CHECK(regions[0].triangles.size() == 24);  // the first region is that of the first triangle
  CHECK(regions[1].triangles.size() == 8);
  CHECK(regions[0].boundary_sides == 16 + 8);
  CHECK(regions[1].boundary_sides == 8);
  CHECK(count(mesh_of(regions[0])).euler() == 0);
  CHECK(count(mesh_of(regions[1])).euler() == 1);
  for (Index v : {6u, 12u, 18u}) CHECK(copies(regions[1], v) == 1);
  CHECK(copies(regions[0], 12) == 0);
}

TEST_CASE("regions: triangles that meet at a node only are two regions, or one with the node twice") {
  SUBCASE("two") {
    Patch patch;
    patch.points = {{0, 0, 0}, {-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}};
    patch.triangles = {{0, 1, 2}, {0, 4, 3}};
    const auto regions = cut(patch);
    REQUIRE(regions.size() == 2);
    for (const Region& region : regions) {
      CHECK(copies(region, 0) == 1);
      mesh_of(region);
    }
  }
  SUBCASE("one: a ring that is pinched") {
    // The cells in the middle of a plate of 3 x 4 are left out up to a corner where two holes touch.
    Patch patch = plate(4, 4);
    std::vector<std::array<Index, 3>> kept;
    for (Index t = 0; t < patch.triangles.size(); ++t) {
      const Index cell = t / 2;
      if (cell != 5 && cell != 10) kept.push_back(patch.triangles[t]);  // cells (1, 1) and (2, 2) share node 12
    }
    patch.triangles = kept;
    const auto regions = cut(patch);
    REQUIRE(regions.size() == 1);
    CHECK(copies(regions[0], 12) == 2);
    CHECK(regions[0].boundary_sides == 16 + 8);
    mesh_of(regions[0]);
  }
}

TEST_CASE("regions: where something touches a node inside, it has a vertex of its own, and the node stays") {
  Patch patch = plate(2, 2);
  patch.points.insert(patch.points.end(), {{0.5, 0.5, 1}, {1.5, 0.5, 1}, {1.5, 1.5, 1}, {0.5, 1.5, 1}});
  SUBCASE("a triangle") { patch.triangles.push_back({4, 10, 11}); }
  SUBCASE("a triangle that comes first") { patch.triangles.insert(patch.triangles.begin(), {4, 10, 11}); }
  SUBCASE("a closed fan") {
    for (Index i = 0; i < 4; ++i) patch.triangles.push_back({4, 9 + i, 9 + (i + 1) % 4});
  }
  SUBCASE("a quad") { patch.quads.push_back({4, 10, 11, 12}); }
  const auto regions = cut(patch);
  REQUIRE(regions.size() == (patch.quads.empty() ? 2 : 1));
  for (const Region& region : regions) {
    REQUIRE(copies(region, 4) == 1);
    mesh_of(region);
    REQUIRE(region.fixed.size() == 1);
    CHECK(region.node[region.fixed[0]] == 4);
  }
}

TEST_CASE("regions: every triangle and every side is in exactly one region, on random constraints") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Patch patch = plate(Index(rng.range(2, 6)), Index(rng.range(2, 6)));
    std::vector<std::array<Index, 2>> inner;
    for (const auto& t : patch.triangles)
      for (int i = 0; i < 3; ++i)
        if (rng.chance(0.15)) patch.constraints.push_back({t[i], t[(i + 1) % 3]});
    const auto regions = cut(patch);
    std::size_t triangles = 0;
    for (const Region& region : regions) {
      triangles += region.triangles.size();
      const Mesh mesh = mesh_of(region);
      // No constraint is inside a region.
      for (const auto& [a, b] : patch.constraints)
        for (Index h = 0; h < mesh.half_edge_slots(); ++h)
          if (region.node[mesh.origin(h)] == a && region.node[mesh.target(h)] == b) REQUIRE(mesh.is_boundary_edge(h));
    }
    REQUIRE(triangles == patch.triangles.size());
  }
}

TEST_CASE("regions: two triangles on one side of an edge are refused, with the edge's coordinates") {
  Patch patch = plate(2, 1);
  SUBCASE("overlap") {
    patch.points.emplace_back(0.5, 0.25, 0);
    patch.triangles.push_back({0, 1, 6});
  }
  SUBCASE("orientation") { std::swap(patch.triangles[0][1], patch.triangles[0][2]); }
  SUBCASE("the same triangle twice") { patch.triangles.push_back(patch.triangles[0]); }
  try {
    cut(patch);
    FAIL("was not refused");
  } catch (const SurfaceError& e) {
    const std::string text = e.what();
    CHECK(text.find("(0, 0, 0)") != std::string::npos);
    CHECK(text.find("same side of the edge") != std::string::npos);
  }
}
