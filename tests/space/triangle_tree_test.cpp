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

TEST_CASE("the closest point of a triangle is its foot, or on the nearest side, whatever its shape") {
  Rng rng(3);
  for (const double height : {1.0, 0.05, 1e-3, 1e-6, 0.0})
    for (int round = 0; round < 200; ++round) {
      const Vector3d a(0, 0, 0), b(1, 0, 0), c(rng.between(-1, 2), height * rng.between(0.5, 1), 0);
      const Vector3d p(rng.between(-2, 3), rng.between(-1, 1), rng.between(-1, 1));
      double best = std::numeric_limits<double>::infinity();
      for (const auto& [q, r] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        best = std::min(best, (q + space::closest_on_segment(p, q, r) * (r - q) - p).norm());
      const Vector3d foot(p.x(), p.y(), 0);
      const auto is_left = [&](const Vector3d& q, const Vector3d& r) { return (r - q).cross(foot - q).z() > 0; };
      if (is_left(a, b) && is_left(b, c) && is_left(c, a)) best = std::abs(p.z());
      CHECK(std::sqrt(space::closest_on_triangle(p, a, b, c).distance2) == doctest::Approx(best).epsilon(1e-9));
    }
}

TEST_CASE("triangle tree: no triangles at all, and triangles in one place") {
  const std::vector<Vector3d> points{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  CHECK(TriangleTree(points, {}).closest({0, 0, 0}).triangle == kNone);
  const std::vector<space::Background::Triangle> triangles(9, {0, 1, 2});
  CHECK(TriangleTree(points, triangles).closest({0, 0, 0}).point == points[0]);
}

}  // namespace
