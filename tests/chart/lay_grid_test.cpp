// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/lay_grid.hpp"

#include <cmath>
#include <set>

#include "chart/fixture.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

/// plate(), bent to a part of a cylinder: its columns go round by `degrees`.
Patch bent_plate(int columns, int rows, double degrees) {
  Patch patch = plate(columns, rows);
  const double turn = degrees * std::numbers::pi / 180, radius = columns / turn;
  for (Eigen::Vector3d& p : patch.points) {
    const double angle = p.x() / radius;
    p = {radius * std::sin(angle), p.y(), radius * std::cos(angle)};
  }
  return patch;
}

}  // namespace

TEST_CASE("lay grid: four sides with as many edges on opposite ones are a grid of them") {
  const Start start(bent_plate(7, 4, 120));
  const auto grid = chart::lay_grid(start.region);
  REQUIRE(grid);
  CHECK(grid->faces.size() == 28);
  std::set<Index> nodes;
  for (const chart::Face& face : grid->faces) nodes.insert(face.begin(), face.end());
  CHECK(nodes.size() == 40);
  CHECK(chart::smallest_own_sine(*grid) > 0.99);
  std::size_t open = 0;
  for (Index side = 0; side < grid->open.size(); ++side) {
    if (!grid->open[side]) continue;
    ++open;
    for (Index i : {side % 4, (side + 1) % 4}) {
      const Index v = grid->faces[side / 4][i];
      REQUIRE(v < start.region.points.size());
      CHECK(grid->points[v] == start.region.points[v]);
    }
  }
  CHECK(open == start.region.region.boundary_sides);
  // New nodes lie on the triangles that they are said to be on.
  for (Index v : nodes) {
    const auto foot = start.region.background->foot_on(grid->on[v], grid->points[v]);
    CHECK((foot.point - grid->points[v]).norm() < 1e-12);
  }
}

TEST_CASE("lay grid: what is no grid is left to others") {
  SUBCASE("a node more on one side") {
    Patch patch = bent_plate(6, 4, 90);
    const auto [a, b, c] = patch.triangles[0];  // the first two are nodes of a side
    patch.points.push_back((patch.points[a] + patch.points[b]) / 2);
    const Index middle = Index(patch.points.size() - 1);
    patch.triangles[0] = {a, middle, c};
    patch.triangles.push_back({middle, b, c});
    CHECK_FALSE(chart::lay_grid(Start(patch).region));
  }
  SUBCASE("a hole") {
    Patch patch = bent_plate(6, 4, 90);
    patch.triangles.erase(patch.triangles.begin() + 16, patch.triangles.begin() + 18);
    CHECK_FALSE(chart::lay_grid(Start(patch).region));
  }
  SUBCASE("creases") { CHECK_FALSE(chart::lay_grid(Start(bent_plate(3, 3, 250), 0.5).region)); }
  SUBCASE("triangles much smaller than the sides' edges say") {
    Patch patch = bent_plate(3, 3, 60);
    std::vector<std::array<Index, 3>> finer;
    for (const auto& [a, b, c] : patch.triangles) {
      patch.points.push_back((patch.points[a] + patch.points[b] + patch.points[c]) / 3);
      const Index middle = Index(patch.points.size() - 1);
      for (const auto& [v, w] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) finer.push_back({v, w, middle});
    }
    patch.triangles = finer;
    CHECK_FALSE(chart::lay_grid(Start(patch).region));
  }
}
