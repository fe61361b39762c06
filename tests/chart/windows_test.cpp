// SPDX-License-Identifier: GPL-2.0-or-later
// Windows around nodes.
#include "chart/windows.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "chart/fixture.hpp"
#include "chart/topology.hpp"

using namespace qmorph;
using namespace qmorph::test;
using namespace qmorph::chart;

TEST_CASE("windows: discs with no face in common, until each node has had one") {
  Rng rng(11);
  for (const Patch& patch : {sphere(0.15, rng), torus(1, 0.3, 0.12, rng), tube(6, 0.4, 0.12, 1, rng), plate(30, 4)}) {
    const Start start(patch);
    const std::vector<bool> walls(4 * start.mesh.faces.size(), false);
    std::vector<char> waiting(start.mesh.points.size(), 0);
    for (std::size_t v = 0; v < waiting.size(); v += 3) waiting[v] = 1;
    int rounds = 0;
    Budget budget(kPlenty);
    while (true) {
      const auto left = std::count(waiting.begin(), waiting.end(), 1);
      const auto windows = take_windows(start.mesh, start.opposite, walls, {6, 3, 200}, waiting, budget);
      std::set<Index> taken;
      for (const Window& window : windows) {
        CHECK(window.faces.size() <= 200);
        CHECK(loops_of(window.laid_out->piece).size() == 1);
        for (Index f : window.faces) CHECK(taken.insert(f).second);
      }
      if (windows.empty()) break;
      CHECK(std::count(waiting.begin(), waiting.end(), 1) < left);
      REQUIRE(++rounds < 200);
    }
    CHECK(std::count(waiting.begin(), waiting.end(), 1) == 0);
  }
}

TEST_CASE("windows: none goes across a wall") {
  const Start start(plate(10, 10));
  std::vector<bool> walls(4 * start.mesh.faces.size(), false);
  for (Index side = 0; side < start.opposite.size(); ++side) {
    const Face& face = start.mesh.faces[side / 4];
    if (side % 4 >= degree(face) || start.opposite[side] == kNone) continue;
    const auto on_middle = [&](Index v) { return start.mesh.points[v].x() == 5; };
    walls[side] = on_middle(face[side % 4]) && on_middle(face[next_corner(face, side % 4)]);
  }
  std::vector<char> waiting(start.mesh.points.size(), 1);
  Budget budget(kPlenty);
  for (const Window& window : take_windows(start.mesh, start.opposite, walls, {6, 3, 500}, waiting, budget)) {
    std::set<bool> halves;
    for (Index f : window.faces) {
      double x = 0;
      for (Index i = 0; i < 3; ++i) x += start.mesh.points[start.mesh.faces[f][i]].x() / 3;
      halves.insert(x > 5);
    }
    CHECK(halves.size() == 1);
  }
}

TEST_CASE("windows: where nothing lies flat, the search ends when its budget is spent") {
  Rng rng(12);
  Start start(sphere(0.06, rng));
  for (Index v = 0; v < start.mesh.points.size(); v += 2) start.mesh.points[v] *= 1.3;  // pleats
  const std::vector<bool> walls(4 * start.mesh.faces.size(), false);
  std::vector<char> waiting(start.mesh.points.size(), 1);
  constexpr std::size_t kEach = 1000, kLastWindow = 800 * 2 * kWorkToLayOut;
  const std::size_t allowed = kEach * start.mesh.faces.size();
  Budget budget{double(allowed)};
  while (!take_windows(start.mesh, start.opposite, walls, {8, 5, 800}, waiting, budget).empty()) {
  }
  CHECK(budget.is_spent());
  CHECK(budget.spent() < double(allowed + kLastWindow + kWorkToLook * start.mesh.faces.size()));
}
