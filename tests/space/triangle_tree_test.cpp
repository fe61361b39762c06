// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/triangle_tree.hpp"

#include <doctest/doctest.h>

#include "space/surfaces.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;
using space::TriangleTree;

TEST_CASE("triangle tree: finds what looking at every triangle finds") {
  for (const Index across : {3u, 7u, 40u}) {
    const Patch patch = torus({.across = across, .along = 5, .jitter = 0.4});
    const TriangleTree tree(patch.points, patch.triangles);
    Rng rng(across);
    for (int round = 0; round < 100; ++round) {
      const Vector3d p(rng.between(-5, 5), rng.between(-5, 5), rng.between(-2, 2));
      double best = std::numeric_limits<double>::infinity();
      for (const auto& [a, b, c] : patch.triangles)
        best =
            std::min(best, space::closest_on_triangle(p, patch.points[a], patch.points[b], patch.points[c]).distance2);
      const space::Foot foot = tree.closest(p);
      CHECK(foot.distance2 == best);
      CHECK((foot.point - p).squaredNorm() == doctest::Approx(best));
      CHECK(tree.closest(p, 0.99 * std::sqrt(best)).triangle == kNone);
    }
  }
}

TEST_CASE("triangle tree: no triangles at all, and triangles in one place") {
  const std::vector<Vector3d> points{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  CHECK(TriangleTree(points, {}).closest({0, 0, 0}).triangle == kNone);
  const std::vector<space::Background::Triangle> triangles(9, {0, 1, 2});
  CHECK(TriangleTree(points, triangles).closest({0, 0, 0}).point == points[0]);
}

}  // namespace
