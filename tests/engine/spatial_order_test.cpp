#include "engine/spatial_order.hpp"

#include <doctest/doctest.h>

#include <algorithm>

namespace {

using namespace qmorph;

TEST_CASE("spatial order: each triangle once, quarter by quarter of the square") {
  // One triangle for each cell of a 4 x 4 grid, numbered row by row.
  std::vector<Vec2> points;
  std::vector<std::array<Index, 3>> triangles;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      const auto first = Index(points.size());
      for (const Vec2& corner : {Vec2(0, 0), Vec2(0.3, 0), Vec2(0, 0.3)}) points.push_back(Vec2(x, y) + corner);
      triangles.push_back({first, first + 1, first + 2});
    }
  CHECK(spatial_order(triangles, points) == std::vector<Index>{0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15});
}

TEST_CASE("spatial order: triangles on one place keep their order, none is no error") {
  const std::vector<Vec2> points = {{1, 1}, {1, 1}, {1, 1}};
  CHECK(spatial_order({{0, 1, 2}, {0, 1, 2}}, points) == std::vector<Index>{0, 1});
  CHECK(spatial_order({}, points).empty());
}

}  // namespace
