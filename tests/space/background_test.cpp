// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/background.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <limits>
#include <set>

#include "space/surfaces.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;
using space::Background;
using space::Foot;

double nearest2(const Patch& patch, const Vector3d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : patch.triangles)
    best = std::min(best, space::closest_on_triangle(p, patch.points[a], patch.points[b], patch.points[c]).distance2);
  return best;
}

TEST_CASE("closest point of a triangle: no point of a fine sampling is nearer, and the weights give the point") {
  Rng rng(3);
  for (int round = 0; round < 200; ++round) {
    const auto random = [&] { return Vector3d(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1)); };
    const Vector3d a = random(), b = random(), p = 2 * random();
    const Vector3d c = round % 4 ? random() : Vector3d(a + rng.between(-1, 2) * (b - a));  // some without area
    const auto foot = space::closest_on_triangle(p, a, b, c);
    CHECK((foot.weights[0] * a + foot.weights[1] * b + foot.weights[2] * c - foot.point).norm() < 1e-12);
    CHECK(foot.weights.minCoeff() >= 0);
    CHECK(std::abs((p - foot.point).squaredNorm() - foot.distance2) < 1e-14);
    constexpr int kSteps = 40;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        const Vector3d sample = a + i * (b - a) / kSteps + j * (c - a) / kSteps;
        CHECK_FALSE((p - sample).squaredNorm() < foot.distance2 - 1e-12);
      }
  }
}

TEST_CASE("closest point of a triangle: a corner is met to the bit") {
  const Vector3d a(0.1, 0.2, 0.3), b(1.7, 0.3, 0.1), c(0.4, 1.9, 0.2);
  CHECK(space::closest_on_triangle(a, a, b, c).point == a);
  CHECK(space::closest_on_triangle(b, a, b, c).point == b);
  CHECK(space::closest_on_triangle(c, a, b, c).point == c);
  CHECK(space::closest_on_triangle({-1, -1, 0}, a, b, c).point == a);
}

TEST_CASE("closest point of a triangle: in needles, as near as rounding allows") {
  Rng rng(5);
  for (const double height : {1e-2, 1e-4, 1e-6, 1e-8})
    for (int round = 0; round < 50; ++round) {
      const Vector3d a(0.1, 0.2, 0), b(1.3, 0.2, 0), c(rng.between(-1, 3), 0.2 + height, 0);
      const double u = rng.between(0.1, 0.4), v = rng.between(0.1, 0.4), above = height * rng.between(0.5, 2);
      const Vector3d under = a + u * (b - a) + v * (c - a), p = under + Vector3d(0, 0, above);
      const auto foot = space::closest_on_triangle(p, a, b, c);
      CHECK(std::abs(std::sqrt(foot.distance2) - above) < 1e-6 * above);
    }
}

TEST_CASE("background: a walk from triangles nearby finds the closest point of all") {
  const Patch patch = torus({.across = 40, .along = 16, .jitter = 0.3});
  const Background surface(patch.points, patch.triangles);
  Rng rng(7);
  for (int round = 0; round < 300; ++round) {
    const Index start = Index(rng.below(patch.triangles.size()));
    Index hint = start;
    for (int step = 0; step < 6; ++step) hint = surface.neighbour(hint, int(rng.below(3)));
    const Vector3d p = (surface.corner(start, 0) + surface.corner(start, 1) + surface.corner(start, 2)) / 3 +
                       rng.between(-0.2, 0.2) * surface.normal(start);
    const Foot foot = surface.walk(p, hint);
    CHECK(foot.distance2 == doctest::Approx(nearest2(patch, p)).epsilon(1e-9));
    CHECK((foot.weights[0] * surface.corner(foot.triangle, 0) + foot.weights[1] * surface.corner(foot.triangle, 1) +
           foot.weights[2] * surface.corner(foot.triangle, 2) - foot.point)
              .norm() < 1e-12);
  }
}

TEST_CASE("background: a walk goes far if it leads downhill all the way") {
  const Patch patch = cylinder({.across = 400, .along = 3}, 0.4);
  const Background surface(patch.points, patch.triangles);
  const Foot foot = surface.walk(patch.points[0], surface.triangles() - 1);
  CHECK(foot.point == patch.points[0]);
}

TEST_CASE("background: no walk crosses a barrier, and fans and normals end there") {
  // Two squares at a right angle, with the edge between them as a barrier or not.
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}};
  const std::vector<Background::Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  const std::vector<Background::Edge> crease{{2, 1}};
  const Background smooth(points, triangles), creased(points, triangles, crease);
  const Vector3d p(0.9, 0.5, 0.8);  // near the second square
  CHECK(smooth.walk(p, 1).triangle >= 2);
  CHECK(creased.walk(p, 1).triangle < 2);
  CHECK(creased.neighbour(0, 1) == kNone);
  CHECK(smooth.neighbour(0, 1) == 3);
  CHECK(smooth.fans() == 6);
  CHECK(creased.fans() == 8);
  CHECK(creased.corner_normal(0, 1) == Vector3d::UnitZ());
  CHECK(creased.corner_normal(3, 0) == -Vector3d::UnitX());
  CHECK(smooth.corner_normal(0, 1) == smooth.corner_normal(3, 0));
  CHECK(creased.normal_near(0) == Vector3d::UnitZ());
}

TEST_CASE("background: edges with three triangles and those between triangles turned against each other are barriers") {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  const std::vector<Background::Triangle> three{{0, 1, 2}, {1, 0, 3}, {1, 0, 4}};
  const std::vector<Background::Triangle> turned{{0, 1, 2}, {0, 1, 3}};
  for (const auto& triangles : {three, turned}) {
    const Background surface(points, triangles);
    for (Index side = 0; side < 3 * triangles.size(); ++side) CHECK(surface.opposite(side) == kNone);
    CHECK(surface.fans() == 3 * triangles.size());
  }
}

TEST_CASE("background: opposite sides name each other, and all corners of a fan are at one node") {
  const Patch patch = cylinder({.across = 12, .along = 4, .jitter = 0.2});
  const Background surface(patch.points, patch.triangles);
  std::size_t open = 0;
  std::vector<Index> node(surface.fans(), kNone);
  for (Index side = 0; side < 3 * surface.triangles(); ++side) {
    const Index t = side / 3, i = side % 3, other = surface.opposite(side);
    Index& of_fan = node[surface.fan(t, int(i))];
    if (of_fan == kNone) of_fan = patch.triangles[t][i];
    CHECK(of_fan == patch.triangles[t][i]);
    if (other == kNone) {
      ++open;
      continue;
    }
    CHECK(surface.opposite(other) == side);
    CHECK(patch.triangles[other / 3][other % 3] == patch.triangles[t][(i + 1) % 3]);
  }
  CHECK(open == 24);
  CHECK(surface.fans() == patch.points.size());
}

TEST_CASE("background: normals of nodes and points are those of the surface") {
  const Patch patch = cylinder({.across = 60, .along = 10, .jitter = 0.2});
  const Background surface(patch.points, patch.triangles);
  for (Index t = 0; t < surface.triangles(); ++t) {
    const Vector3d weights(0.2, 0.5, 0.3);
    const Vector3d p =
        weights[0] * surface.corner(t, 0) + weights[1] * surface.corner(t, 1) + weights[2] * surface.corner(t, 2);
    CHECK(surface.smooth_normal(t, weights).dot(Vector3d(p.x(), p.y(), 0).normalized()) > 0.999);
    CHECK(surface.normal_near(t).dot(Vector3d(p.x(), p.y(), 0).normalized()) > 0.998);
  }
}

TEST_CASE("background: triangles without area have no normal, but walks pass them") {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}};
  // In the middle lies 0, 2, 1 without area.
  const std::vector<Background::Triangle> triangles{{0, 1, 3}, {1, 2, 3}, {0, 2, 1}, {0, 4, 2}};
  const Background surface(points, triangles);
  CHECK(surface.normal(2) == Vector3d::Zero());
  CHECK(surface.corner_normal(2, 0) == Vector3d::UnitZ());
  CHECK(surface.walk({0.9, 0.5, 0.1}, 3).triangle == 0);
  CHECK((surface.walk({0.9, 0.5, 0.1}, 3).point - Vector3d(0.9, 0.5, 0)).norm() < 1e-15);
}

}  // namespace
