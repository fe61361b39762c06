// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles without area on a straight side.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "qmorph/convert.hpp"
#include "support/invariants.hpp"
#include "support/rng.hpp"
#include "support/seeds.hpp"

namespace {

using namespace qmorph;

/// A square with a node in the middle. One of its sides has other nodes, too, that are linked by flat triangles only.
struct FlatSide {
  Patch patch;
  test::Rng rng;

  explicit FlatSide(std::uint64_t seed) : rng(seed) {
    const double turn = rng.between(0, 7), size = rng.power_of_two(-20, 20);
    const auto add = [&](double x, double y) {
      patch.points.emplace_back(size * (std::cos(turn) * x - std::sin(turn) * y),
                                size * (std::sin(turn) * x + std::cos(turn) * y), 0);
    };
    add(0, 0), add(1, 0), add(1, 1), add(0, 1), add(0.5, 0.4);
    patch.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    std::vector<Index> side{0};
    const int inner = 2 * rng.range(1, 10);
    for (int i = 1; i <= inner; ++i) {
      side.push_back(Index(patch.points.size()));
      add((i + rng.between(-0.3, 0.3)) / (inner + 1), 0);
    }
    side.push_back(1);
    divide(side, 0, side.size() - 1);
    rng.shuffle(patch.triangles);
  }

  /// A flat triangle over the edge from one node of the side to another, and others below it.
  void divide(const std::vector<Index>& side, std::size_t first, std::size_t last) {
    if (last - first < 2) return;
    const std::size_t middle = first + 1 + rng.below(last - first - 1);
    patch.triangles.push_back({side[first], side[middle], side[last]});
    divide(side, first, middle), divide(side, middle, last);
  }
};

}  // namespace

TEST_CASE("prepare: flat triangles nested along a straight side are swapped away, whatever their order") {
  for (std::uint64_t seed = 0; seed < test::seeds(60, 12); ++seed) {
    CAPTURE(seed);
    const Patch patch = FlatSide(seed).patch;
    const QuadMesh mesh = convert(patch).mesh;
    CHECK(mesh.quads.size() * 2 >= patch.triangles.size() - 4);
    CHECK(test::broken_invariants(patch, mesh) == std::vector<std::string>());
  }
}

TEST_CASE("prepare: flat triangles back to back, with fixed nodes, are refused with their place") {
  Patch patch;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {0.5, 1.0}, {0.4, 0.0}, {0.6, 0.0}, {0.5, -1.0}})
    patch.points.emplace_back(x, y, 0);
  patch.triangles = {{0, 3, 1}, {0, 1, 4}, {0, 4, 2}, {4, 1, 2}, {0, 5, 3}, {3, 5, 1}};
  patch.fixed = {0, 1, 2, 3, 4, 5};
  std::string refusal;
  try {
    convert(patch);
  } catch (const SurfaceError& error) {
    refusal = error.what();
  }
  CHECK(refusal.find("(0.4, 0, 0), (1, 0, 0) has no area") != std::string::npos);
}
