// SPDX-License-Identifier: GPL-2.0-or-later
// Patches that the engine must refuse, with a message that says where.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>

#include "qmorph/convert.hpp"
#include "support/domains.hpp"
#include "support/rng.hpp"

namespace {

using qmorph::Index;
using qmorph::Patch;

// 6---7---8
// | / | / |
// 3---4---5
// | / | / |
// 0---1---2
Patch grid() {
  Patch patch;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) patch.points.emplace_back(x, y, 0);
  for (const Index a : {0u, 1u, 3u, 4u}) {
    patch.triangles.push_back({a, a + 1, a + 4});
    patch.triangles.push_back({a, a + 4, a + 3});
  }
  return patch;
}

/// The message of the SurfaceError; empty if there was none.
std::string refusal(const Patch& patch) {
  try {
    qmorph::convert(patch);
  } catch (const qmorph::SurfaceError& e) {
    return e.what();
  }
  return "";
}

/// A band around the origin; from `turns` = 1 on it lies over itself.
Patch spiral(double turns, double growth) {
  Patch patch;
  const int steps = int(24 * turns);
  for (int i = 0; i <= steps; ++i)
    for (const double radius : {1.0, 2.0}) {
      const double angle = 2 * 3.14159265358979323846 * i / 24, r = radius + growth * i / 24;
      patch.points.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
  for (Index i = 0; i < Index(steps); ++i) {
    const Index a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
    patch.triangles.push_back({a, b, d});
    patch.triangles.push_back({a, d, c});
  }
  return patch;
}

}  // namespace

TEST_CASE("a good patch is not refused") { CHECK(refusal(grid()) == ""); }

TEST_CASE("patches that are curved, or bent at a right angle, are not refused") {
  Patch patch = grid();
  SUBCASE("curved") { patch.points[4].z() = 0.2; }
  SUBCASE("bent") {
    for (const Index i : {2u, 5u, 8u}) patch.points[i] = {1, patch.points[i].y(), 1};
  }
  CHECK(refusal(patch) == "");
}

TEST_CASE("patches that are refused with SurfaceError") {
  Patch patch = grid();
  SUBCASE("a coordinate that is no number") { patch.points[4].x() = std::numeric_limits<double>::quiet_NaN(); }
  SUBCASE("a coordinate that is infinite") { patch.points[4].y() = std::numeric_limits<double>::infinity(); }
  SUBCASE("a triangle turned over by its node") { patch.points[4] = {2.5, 1, 0}; }
  SUBCASE("a triangle of the other orientation") { std::swap(patch.triangles[3][0], patch.triangles[3][1]); }
  SUBCASE("three triangles at an edge") {
    patch.points.emplace_back(1.4, 0.6, 0);
    patch.triangles.push_back({0, 9, 4});
  }
  SUBCASE("a triangle twice") { patch.triangles.push_back(patch.triangles[0]); }
  SUBCASE("a node number that does not exist") { patch.triangles[0][1] = 9; }
  SUBCASE("a triangle with a node twice") { patch.triangles[0] = {0, 1, 1}; }
  SUBCASE("a triangle over others, with two of their nodes") {
    patch.points.emplace_back(1.8, 1, 0);
    patch.triangles.push_back({3, 9, 5});  // from node 3 over node 4; its sides touch those of others, and cross none
    patch.points[5] = {2, 1.2, 0};
  }
  SUBCASE("a node that is covered twice") {  // a fan of 720 degrees
    patch = {};
    patch.points.emplace_back(0, 0, 0);
    for (int i = 0; i < 12; ++i) {
      const double angle = 3.14159265358979323846 * i / 3;
      patch.points.emplace_back((1 + 0.1 * i) * std::cos(angle), (1 + 0.1 * i) * std::sin(angle), 0);
    }
    for (Index i = 0; i < 12; ++i) patch.triangles.push_back({0, 1 + i, 1 + (i + 1) % 12});
  }
  CHECK(refusal(patch) != "");
}

TEST_CASE("surfaces ten million times longer than high become quads, needles at their ends, too") {
  const auto strip = [](double height, double height_at_ends) {
    Patch patch;
    const Index steps = 40;
    for (Index i = 0; i <= steps; ++i)
      for (const double y : {0.0, height})
        patch.points.emplace_back(i, i == 0 || i == steps ? y * height_at_ends : y, 0);
    for (Index i = 0; i < steps; ++i) {
      const Index a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
      patch.triangles.push_back({a, c, b});
      patch.triangles.push_back({b, c, d});
    }
    return patch;
  };
  CHECK(refusal(strip(1e-3, 1)) == "");
  CHECK(refusal(strip(1e-7, 1)) == "");
  // Needles at both ends.
  Patch needle = strip(1e-7, 0);
  needle.triangles.erase(needle.triangles.begin());
  needle.triangles.pop_back();
  for (auto& t : needle.triangles)
    for (Index& v : t)
      if (v == 1 || v == 81) --v;
  CHECK(refusal(needle) == "");
}

TEST_CASE("a band that lies over itself is refused, one that does not is not") {
  CHECK(refusal(spiral(0.9, 0)) == "");
  CHECK(refusal(spiral(1.5, 1.2)) == "");  // each turn outside the one before
  CHECK(refusal(spiral(1.5, 0.5)) != "");
}

TEST_CASE("nodes that are off by a hundredth of an edge break no more than the surface that they belong to") {
  // Some of these have layers beside a region that is stuck, and which is left out at first.
  for (std::uint64_t seed = 46; seed < 58; ++seed) {
    Patch patch = qmorph::test::random_domain(seed).patch;
    qmorph::test::Rng rng(seed);
    const Eigen::Vector3d a = patch.points[patch.triangles[0][1]] - patch.points[patch.triangles[0][0]];
    const Eigen::Vector3d normal =
        a.cross(patch.points[patch.triangles[0][2]] - patch.points[patch.triangles[0][0]]).normalized();
    for (Eigen::Vector3d& p : patch.points) {
      const Eigen::Vector3d step(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1));
      p += 0.01 * a.norm() * (step - step.dot(normal) * normal);
    }
    CAPTURE(seed);
    try {
      const qmorph::QuadMesh mesh = qmorph::convert(patch).mesh;  // thrown inside CHECK it would count as a failure
      CHECK(mesh.quads.size() >= patch.quads.size());
    } catch (const qmorph::SurfaceError& error) {
      CHECK(error.place());
    }
  }
}
