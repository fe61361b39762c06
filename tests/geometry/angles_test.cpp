// SPDX-License-Identifier: GPL-2.0-or-later
// Plane vectors: angles, and when a corner counts as convex.
#include <doctest/doctest.h>

#include "geometry/predicates.hpp"

namespace {

using namespace qmorph;
constexpr double kPi = std::numbers::pi;
const Vec2 kEast(1, 0), kNorth(0, 1), kWest(-1, 0), kSouth(0, -1);

}  // namespace

TEST_CASE("left_of turns a quarter counter-clockwise, rotated by any angle") {
  CHECK(left_of(Vec2(2, 1)) == Vec2(-1, 2));
  for (const double angle : {-2.0, 0.1, 0.5 * kPi, 3.0}) {
    const Vec2 v = rotated(Vec2(0, 2), angle);
    CHECK(v.norm() == doctest::Approx(2));
    CHECK(signed_angle(Vec2(0, 2), v) == doctest::Approx(angle));
  }
}

TEST_CASE("signed_angle lies in (-pi, pi], ccw_angle in [0, 2 pi)") {
  CHECK(signed_angle(kEast, kNorth) == doctest::Approx(0.5 * kPi));
  CHECK(signed_angle(kEast, kSouth) == doctest::Approx(-0.5 * kPi));
  CHECK(signed_angle(kEast, kWest) == doctest::Approx(kPi));
  CHECK(signed_angle(kEast, kEast) == 0);
  CHECK(ccw_angle(kEast, kNorth) == doctest::Approx(0.5 * kPi));
  CHECK(ccw_angle(kEast, kSouth) == doctest::Approx(1.5 * kPi));
  CHECK(ccw_angle(kEast, kWest) == doctest::Approx(kPi));
  CHECK(ccw_angle(kNorth, kNorth) == 0);
  CHECK(ccw_angle(Vec2(1, 0), Vec2(1e9, -1)) < 2 * kPi);
}

TEST_CASE("ccw_angle there and back make a full turn") {
  for (double a = 0.1; a < 6.2; a += 0.37)
    for (double length : {1e-9, 1.0, 1e9})
      CHECK(ccw_angle(kEast, rotated(kEast * length, a)) + ccw_angle(rotated(kEast, a), kEast) ==
            doctest::Approx(2 * kPi));
}

TEST_CASE("corner_sine is positive exactly at convex corners") {
  CHECK(corner_sine({0, 0}, {3, 0}, {0, 0.1}) == doctest::Approx(1));
  CHECK(corner_sine({0, 0}, {1, 0}, {1, 1}) == doctest::Approx(std::sqrt(0.5)));
  CHECK(corner_sine({0, 0}, {1, 0}, {-1, 0}) == 0);                   // straight
  CHECK(corner_sine({0, 0}, {0, 1}, {1, 0}) == doctest::Approx(-1));  // reflex
  CHECK(corner_sine({2, 2}, {2, 2}, {5, 1}) == 0);                    // an edge without length
}

TEST_CASE("is_convex_corner requires more than the given sine, at any scale") {
  for (const double size : {1e-12, 1.0, 1e12}) {
    const Vec2 a(size, 0), b(0, 0);
    const auto corner = [&](double angle) { return Vec2(rotated(Vec2(size * 0.01, 0), angle)); };
    // A polygon that runs next, corner, previous is convex at the corner where it turns left: previous is the first.
    CHECK(is_convex_corner(corner(0.5 * kPi), b, a, 0.9));
    CHECK(is_convex_corner(corner(0.11), b, a, 0.1));
    CHECK_FALSE(is_convex_corner(corner(0.09), b, a, 0.1));
    CHECK(is_convex_corner(corner(kPi - 0.11), b, a, 0.1));
    CHECK_FALSE(is_convex_corner(corner(kPi - 0.09), b, a, 0.1));
    CHECK_FALSE(is_convex_corner(corner(-0.5 * kPi), b, a, 0));  // reflex
    CHECK_FALSE(is_convex_corner(corner(0), b, a, 0));           // closed
    CHECK_FALSE(is_convex_corner(a, b, b, 0));                   // no length
  }
}

TEST_CASE("a straight corner of a quad is not convex, a sliver of a triangle still is") {
  const Vec2 sliver = rotated(Vec2(1, 0), 1e-8);
  CHECK_FALSE(is_convex_corner(sliver, {0, 0}, {1, 0}, kStraightSine));
  CHECK(is_convex_corner(sliver, {0, 0}, {1, 0}, kDegenerateSine));
  CHECK_FALSE(is_convex_corner(rotated(Vec2(1, 0), 1e-11), {0, 0}, {1, 0}, kDegenerateSine));
}
