// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/z_curve.hpp"

#include <doctest/doctest.h>

namespace {

using namespace qmorph;

TEST_CASE("Z-curve: each point once, quarter by quarter of the square") {
  std::vector<Vec2> points;  // numbered row by row
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) points.emplace_back(x, y);
  CHECK(along_z_curve(points) == std::vector<Index>{0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15});
}

TEST_CASE("Z-curve: coincident points keep their order, and no points at all are no error") {
  CHECK(along_z_curve({{1, 1}, {1, 1}, {1, 1}}) == std::vector<Index>{0, 1, 2});
  CHECK(along_z_curve({}).empty());
}

}  // namespace
