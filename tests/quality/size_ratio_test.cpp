// SPDX-License-Identifier: GPL-2.0-or-later
#include "quality/size_ratio.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "quality/percentile.hpp"

namespace {

using qmorph::Index;

/// Squares between the lines x = c^0, c^1, ...; n by n.
template <class Mesh>
Mesh points_of_grid(Index n, double growth) {
  Mesh mesh;
  for (Index y = 0; y <= n; ++y)
    for (Index x = 0; x <= n; ++x) mesh.points.emplace_back(std::pow(growth, x), std::pow(growth, y), 0);
  return mesh;
}

qmorph::Patch triangles(Index n, double growth) {
  auto patch = points_of_grid<qmorph::Patch>(n, growth);
  for (Index y = 0; y < n; ++y)
    for (Index x = 0; x < n; ++x) {
      const Index a = x + y * (n + 1), d = a + n + 1;
      patch.triangles.push_back({a, a + 1, d});
      patch.triangles.push_back({a + 1, d + 1, d});
    }
  return patch;
}

qmorph::QuadMesh squares(Index n, double growth) {
  auto mesh = points_of_grid<qmorph::QuadMesh>(n, growth);
  for (Index y = 0; y < n; ++y)
    for (Index x = 0; x < n; ++x) {
      const Index a = x + y * (n + 1), d = a + n + 1;
      mesh.quads.push_back({a, a + 1, d + 1, d});
    }
  return mesh;
}

}  // namespace

TEST_CASE("sizes: quads on the triangles' nodes have the triangles' size, graded or not") {
  for (const double growth : {1.02, 1.2}) {
    std::vector<double> ratios = qmorph::size_ratios(triangles(20, growth), squares(20, growth));
    CHECK(ratios.size() == 2 * 20 * 19);
    CHECK(qmorph::percentile(ratios, 50) == doctest::Approx(1).epsilon(0.1));
  }
}

TEST_CASE("sizes: quads twice as large are seen as such") {
  std::vector<double> ratios = qmorph::size_ratios(triangles(40, 1.02), squares(20, 1.02 * 1.02));
  CHECK(qmorph::percentile(ratios, 50) == doctest::Approx(2).epsilon(0.1));
}

TEST_CASE("sizes: one triangle has no inner edge, and an empty mesh has no size") {
  qmorph::QuadMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  CHECK(qmorph::size_ratios(triangles(2, 1.1), mesh).empty());
  CHECK(qmorph::size_ratios({}, mesh).empty());
}
