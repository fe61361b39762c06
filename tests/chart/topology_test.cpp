// SPDX-License-Identifier: GPL-2.0-or-later
// What kind of surface a piece is.
#include "chart/topology.hpp"

#include <doctest/doctest.h>

#include "chart/fixture.hpp"

using namespace qmorph;
using namespace qmorph::test;
using namespace qmorph::chart;

TEST_CASE("topology: loops and Euler characteristic of well-known surfaces") {
  Rng rng(3);
  struct Case {
    const char* name;
    Patch patch;
    std::size_t loops;
    int euler;
    bool planar;
  };
  for (const Case& c :
       {Case{"plate", plate(4, 3), 1, 1, true}, Case{"sphere", sphere(0.4, rng), 0, 2, false},
        Case{"torus", torus(1, 0.4, 0.2, rng), 0, 0, false}, Case{"double torus", double_torus(0.2, rng), 0, -2, false},
        Case{"tube", tube(2, 0.4, 0.2, 1, rng), 2, 0, true},
        Case{"torus with a hole", pierced(torus(1, 0.4, 0.2, rng), {1.4, 0, 0}, 0.3), 1, -1, false}}) {
    CAPTURE(c.name);
    const Start start(c.patch);
    const Piece piece = start.whole();
    CHECK(loops_of(piece).size() == c.loops);
    CHECK(euler_characteristic(piece) == c.euler);
    CHECK(is_planar_topology(piece) == c.planar);
  }
}

TEST_CASE("topology: a slit has two sides, and its ends have one node") {
  Patch patch = plate(6, 6);
  for (Index v : {23, 24}) patch.constraints.push_back({v, v + 1});  // inside, two edges
  const Start start(patch);
  const Piece piece = start.whole();
  const auto loops = loops_of(piece);
  REQUIRE(loops.size() == 2);
  CHECK(std::min(loops[0].size(), loops[1].size()) == 4);
  CHECK(piece.points.size() == patch.points.size() + 1);
  CHECK(piece.boundary_sides == 24 + 4);
}

TEST_CASE("topology: what is cut apart falls into components") {
  const Start start(plate(4, 2));
  std::vector<bool> cut(4 * start.mesh.faces.size(), false);
  CHECK(components(start.all(), start.opposite, cut).size() == 1);
  cut.assign(cut.size(), true);
  CHECK(components(start.all(), start.opposite, cut).size() == 16);
}

TEST_CASE("topology: angle defects sum up to 2 pi times the Euler characteristic") {
  Rng rng(4);
  for (const auto& [patch, euler] : {std::pair(sphere(0.3, rng), 2), std::pair(torus(1, 0.3, 0.2, rng), 0),
                                     std::pair(double_torus(0.2, rng), -2), std::pair(plate(3, 3), 1)}) {
    double sum = 0;
    for (double defect : angle_defects(Start(patch).whole())) sum += defect;
    CHECK(sum == doctest::Approx(2 * std::numbers::pi * euler));
  }
}
