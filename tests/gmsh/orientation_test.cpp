// SPDX-License-Identifier: GPL-2.0-or-later
// Which way the elements of a surface face.
#include "gmsh/model/orientation.hpp"

#include <doctest/doctest.h>

using namespace qmorph;

TEST_CASE("orientation: parts are counted, and the smaller share of each is turned") {
  const std::vector<std::array<Index, 3>> triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {10, 11, 12}};
  //                                             the third runs along 0-2 as the first runs along 2-0: fine
  const auto sides = sorted_sides(13, triangles, {});
  const adapter::Orientation good = adapter::orient(4, sides);
  CHECK(good.defect == nullptr);
  CHECK(good.parts == 2);
  CHECK(good.flipped == 0);
  const std::vector<std::array<Index, 3>> mixed = {{1, 0, 2}, {1, 0, 3}, {0, 2, 4}, {10, 11, 12}};
  const adapter::Orientation fixed = adapter::orient(4, sorted_sides(13, mixed, {}));
  CHECK(fixed.flipped == 1);
  CHECK(fixed.flip[0]);
}
