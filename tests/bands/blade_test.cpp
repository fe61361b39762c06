// SPDX-License-Identifier: GPL-2.0-or-later
// Thin regions that run out in a sharp corner.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "bands/lay_blade.hpp"
#include "engine/regions.hpp"
#include "kernel/fixture.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// Two sides from a corner on, with the corner, and triangles between them.
Region between(const std::vector<Vec2>& below, const std::vector<Vec2>& above, bool meet_again) {
  Patch patch;
  for (const Vec2& p : below) patch.points.emplace_back(p.x(), p.y(), 0);
  const auto upper = [&](std::size_t j) {
    if (j == 0) return Index(0);
    return meet_again && j + 1 == above.size() ? Index(below.size() - 1) : Index(below.size() - 1 + j);
  };
  for (std::size_t j = 1; j + (meet_again ? 1 : 0) < above.size(); ++j)
    patch.points.emplace_back(above[j].x(), above[j].y(), 0);
  std::size_t i = 0, j = 0;
  while (i + 1 < below.size() || j + 1 < above.size()) {
    const bool lower_next =
        j + 1 == above.size() || (i + 1 < below.size() && (i + 1) * (above.size() - 1) <= (j + 1) * (below.size() - 1));
    const Index a = Index(i), b = upper(j), c = lower_next ? Index(++i) : upper(++j);
    if (a != b && b != c && a != c) patch.triangles.push_back({a, c, b});
  }
  std::vector<Vec2> points;
  for (const auto& p : patch.points) points.push_back(p.head<2>());
  return cut_into_regions(patch, points)[0];
}

/// An arc from (0, 0) to (1, 0) that rises by so much.
std::vector<Vec2> arc(int edges, double height) {
  std::vector<Vec2> points;
  for (int i = 0; i <= edges; ++i) {
    const double x = double(i) / edges;
    points.emplace_back(x, 4 * height * x * (1 - x));
  }
  return points;
}

double tip_sine(const std::vector<Vec2>& below, const std::vector<Vec2>& above) {
  return corner_sine(below[0], below[1], above[1]);
}

void check(const Region& region, const kernel::Mesh& mesh) {
  CHECK(defect(mesh) == "");
  CHECK(count_quads(mesh) == count(mesh).faces);
  CHECK(boundary_of(mesh).size() == region.boundary_sides);
}

}  // namespace

TEST_CASE("blades: in a crescent only quads in its corners are poor, and a few where one side has more nodes") {
  for (int more : {-4, -2, 0, 2, 4})
    for (double height : {0.05, 0.1}) {
      CAPTURE(more);
      CAPTURE(height);
      const std::vector<Vec2> below = arc(20, 0.2), above = arc(20 + more, 0.2 + height);
      const Region region = between(below, above, true);
      const auto mesh = bands::lay_blade(region);
      REQUIRE(mesh);
      check(region, *mesh);
      int poor = 0;
      for (Index f = 0; f < mesh->face_slots(); ++f) poor += mesh->is_live_face(f) && !mesh->is_above(f, 0.3);
      CHECK(poor <= 2 + 2 * std::abs(more));
      CHECK(topology::smallest_sine(*mesh) > 0.3 * tip_sine(below, above));
    }
}

TEST_CASE("blades: a wedge ends at its other side, however many rows that has room for") {
  for (int rows : {1, 2, 3}) {
    CAPTURE(rows);
    std::vector<Vec2> below, above;
    for (int i = 0; i <= 12; ++i) below.emplace_back(i, 0), above.emplace_back(i, 0.08 * rows * i);
    for (int k = 1; k < rows; ++k) below.emplace_back(12, 0.96 * k);  // the end, up to the last node of the other side
    if (rows % 2 == 1) below.insert(below.begin() + 7, Vec2(6.5, 0));
    const Region region = between(below, above, false);
    REQUIRE(region.boundary_sides % 2 == 0);
    const auto mesh = bands::lay_blade(region);
    REQUIRE(mesh);
    check(region, *mesh);
    CHECK(topology::smallest_sine(*mesh) > 0.3 * tip_sine(below, above));
  }
}

TEST_CASE("blades: no way without a sharp corner, or with an odd boundary") {
  CHECK(!bands::lay_blade(between(arc(8, -0.5), arc(8, 0.5), true)));
  CHECK(!bands::lay_blade(between(arc(8, 0.2), arc(9, 0.3), true)));
}
