// SPDX-License-Identifier: GPL-2.0-or-later
// The plane of a surface, and surfaces that have none.
#include <doctest/doctest.h>

#include <limits>
#include <numbers>

#include "engine/regions.hpp"
#include "qmorph/convert.hpp"
#include "support/rng.hpp"

namespace {

using namespace qmorph;
using Eigen::Vector3d;

/// Four triangles around the node 4 in the plane through `origin` along u and v.
Patch square(const Vector3d& origin, const Vector3d& u, const Vector3d& v) {
  Patch patch;
  for (const auto& [x, y] : {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}, {0.1, 0.2}})
    patch.points.push_back(origin + x * u + y * v);
  patch.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return patch;
}

std::string refusal(const Patch& patch) {
  try {
    convert(patch);
  } catch (const SurfaceError& e) {
    return e.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const Vector3d kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

}  // namespace

TEST_CASE("plane: the six coordinate planes are exact, there and back to the bit") {
  const Vector3d origin(0.1, 1.0 / 3, -7e5);
  for (const auto& [u, v] : {std::pair(kX, kY), {kY, kX}, {kY, kZ}, {kZ, kY}, {kZ, kX}, {kX, kZ}}) {
    const Patch patch = square(origin, u, v);
    const Plane plane = *find_plane(patch);
    CHECK(plane.normal() == u.cross(v));
    for (const auto& p : patch.points) CHECK(plane.to_space(plane.to_plane(p)) == p);
  }
}

TEST_CASE("plane: a tilted one has unit axes, the normal of its elements, and passes through the nodes") {
  test::Rng rng(5);
  for (int i = 0; i < 500; ++i) {
    const auto random = [&] { return Vector3d(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1)); };
    const double size = rng.power_of_two(-20, 20);
    const Vector3d u = random().normalized(), v = u.cross(random()).normalized();
    const Patch patch = square(size * 3 * random(), size * u, size * v);
    const Plane plane = *find_plane(patch);
    CHECK(plane.axis_u.norm() == doctest::Approx(1));
    CHECK(plane.axis_v.norm() == doctest::Approx(1));
    CHECK(std::abs(plane.axis_u.dot(plane.axis_v)) < 1e-12);
    CHECK((plane.normal() - u.cross(v)).norm() < 1e-9);
    for (const auto& p : patch.points) CHECK((plane.to_space(plane.to_plane(p)) - p).norm() < 1e-12 * size * 10);
    for (const auto& t : patch.triangles) {  // counter-clockwise in the plane, whatever the sense in space
      const Vec2 a = plane.to_plane(patch.points[t[0]]);
      CHECK(cross(plane.to_plane(patch.points[t[1]]) - a, plane.to_plane(patch.points[t[2]]) - a) > 0);
    }
  }
}

TEST_CASE("plane: a clockwise patch is seen from below, and its result is clockwise") {
  Patch patch = square(Vector3d::Zero(), kX, kY);
  for (auto& t : patch.triangles) std::swap(t[1], t[2]);
  CHECK(find_plane(patch)->normal() == -kZ);
  const QuadMesh result = convert(patch).mesh;
  REQUIRE(result.quads.size() >= 1);
  for (const auto& q : result.quads) {
    const Vector3d d1 = result.points[q[2]] - result.points[q[0]], d2 = result.points[q[3]] - result.points[q[1]];
    CHECK(d1.cross(d2).z() < 0);
  }
}

TEST_CASE("plane: rounding errors off the plane do not tilt it") {
  Patch patch = square({0, 0, 2}, kX, kY);
  patch.points[4].z() += 1e-15;
  const Plane plane = *find_plane(patch);
  CHECK(plane.axis_u == kX);
  CHECK(plane.axis_v == kY);
}

TEST_CASE("plane: a nearly planar patch is planar, and a node off the plane makes a curved surface") {
  Patch patch = square(Vector3d::Zero(), kX, kY);
  patch.points[4].z() = 1e-7;  // a file with seven digits may have moved it
  CHECK(find_plane(patch));
  patch.points[4].z() = 1e-3;
  CHECK_FALSE(find_plane(patch));
  CHECK(refusal(patch) == "");
}

TEST_CASE("plane: what has no area or no place is refused, with coordinates") {
  Patch patch = square(Vector3d::Zero(), kX, kY);
  SUBCASE("a coordinate that is no number, by the node that has it") {
    patch.points[3].y() = std::numeric_limits<double>::quiet_NaN();
    CHECK(contains(refusal(patch), "node 3"));
  }
  SUBCASE("a coordinate whose powers overflow, by the node that has it") {
    patch.points[3].y() = -1e200;
    CHECK(contains(refusal(patch), "node 3"));
    CHECK(contains(refusal(patch), "too large to compute with"));
  }
  SUBCASE("no area in sum") {
    for (auto& p : patch.points) p.y() = 0;
    CHECK(contains(refusal(patch), "no area"));
  }
}

TEST_CASE("convert refuses triangles that cannot be linked, with coordinates") {
  Patch patch = square(Vector3d(10, 0, 0), kX, kY);
  SUBCASE("a node twice in one triangle") { patch.triangles[1] = {1, 1, 4}; }
  SUBCASE("two triangles on one side of an edge") { patch.triangles.push_back({0, 1, 2}); }
  const std::string text = refusal(patch);
  CHECK(text != "");
  CHECK(contains(text, "(1"));  // x is 9 to 11
}

TEST_CASE("convert refuses a triangle that is turned over, whether its node may move or not") {
  Patch patch = square(Vector3d(10, 0, 0), kX, kY);
  patch.points[4] = {12.5, 0, 0};
  SUBCASE("free") {}
  SUBCASE("fixed") { patch.fixed = {4}; }
  CHECK(contains(refusal(patch), "(12.5, 0, 0)"));
}

TEST_CASE("convert refuses a triangle that is turned over where all others are halves of a layer's quads") {
  // A ring of two rows; a node of its outer rim has been put onto one of its inner rim.
  Patch patch;
  for (const double radius : {2.0, 2.5, 3.0})
    for (int i = 0; i < 5; ++i) {
      const double angle = 2 * std::numbers::pi * i / 5;
      patch.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
  for (Index row : {0u, 5u})
    for (Index i = 0; i < 5; ++i) {
      const Index a = row + i, b = row + (i + 1) % 5;
      patch.triangles.insert(patch.triangles.end(), {{a, a + 5, b + 5}, {a, b + 5, b}});
    }
  CHECK(refusal(patch) == "");
  patch.points[11] = patch.points[1];
  CHECK(contains(refusal(patch), "is turned over"));
}

TEST_CASE("convert repairs a triangle without area if its node is free to move") {
  Patch patch = square(Vector3d::Zero(), kX, kY);
  patch.points[4] = {1, 0, 0};
  const QuadMesh result = convert(patch).mesh;
  REQUIRE(result.quads.size() == 1);
  CHECK(result.triangles.empty());
  for (Index v : result.quads[0]) CHECK(result.source[v] < 4);
}
