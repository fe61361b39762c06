// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/faults.hpp"

#include <doctest/doctest.h>

#include <array>
#include <optional>

#include "space/result.hpp"

using namespace qmorph;

TEST_CASE("faults: how far a node may be from the surface goes by the triangles, where the quads are smaller") {
  const Patch patch{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}, {}, {}};
  QuadMesh mesh{patch.points, {0, 1, 2, 3}, {}, {}};
  for (const auto& [x, y] : {std::array{1.8, 1.8}, {2.2, 1.8}, {2.2, 2.2}, {1.8, 2.2}}) {
    mesh.points.emplace_back(x, y, 1);
    mesh.source.push_back(kNone);
  }
  mesh.quads = {{4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  const auto defect = [&](double beside) { return space::find_defect(patch, space::Result(patch, mesh), 0, beside); };
  CHECK_FALSE(defect(1));
  REQUIRE(defect(0.1));
  CHECK(defect(0.1)->what == "a node has left the surface at (1.8, 1.8, 1)");
}
