// SPDX-License-Identifier: GPL-2.0-or-later
// Laws of the exact predicate, and what it says where doubles are not enough.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "geometry/predicates.hpp"
#include "support/rng.hpp"

namespace {

using qmorph::orientation;
using qmorph::Vec2;
using qmorph::test::Rng;

/// Points that make trouble: on a coarse lattice, nearly on a line, far from the origin, tiny.
Vec2 nasty_point(Rng& rng) {
  const double t = rng.range(-4, 4);
  switch (rng.below(5)) {
    case 0:
      return {double(rng.range(-3, 3)), double(rng.range(-3, 3))};
    case 1:
      return {t, std::nextafter(3 * t, rng.chance(0.5) ? 99 : -99)};
    case 2:
      return {t * 0x1p-40, 3 * t * 0x1p-40};
    case 3:
      return {1e8 + t * 0x1p-20, 3e8 + 3 * t * 0x1p-20};
    default:
      return {rng.between(-1, 1), rng.between(-1, 1)};
  }
}

}  // namespace

TEST_CASE("orientation: left, right and on the line") {
  CHECK(orientation({0, 0}, {1, 0}, {0, 1}) == 1);
  CHECK(orientation({0, 0}, {0, 1}, {1, 0}) == -1);
  CHECK(orientation({0, 0}, {1, 1}, {2, 2}) == 0);
  CHECK(orientation({0, 0}, {0, 0}, {1, 5}) == 0);
  CHECK(orientation({2, 3}, {2, 3}, {2, 3}) == 0);
}

TEST_CASE("orientation: rotating the arguments changes nothing, exchanging two changes the sign") {
  Rng rng(1);
  int straight = 0, turned = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec2 a = nasty_point(rng), b = nasty_point(rng), c = nasty_point(rng);
    const int sign = orientation(a, b, c);
    REQUIRE(orientation(b, c, a) == sign);
    REQUIRE(orientation(c, a, b) == sign);
    REQUIRE(orientation(b, a, c) == -sign);
    REQUIRE(orientation(a, c, b) == -sign);
    REQUIRE(orientation(c, b, a) == -sign);
    ++(sign == 0 ? straight : turned);
  }
  CHECK(straight > 500);  // the law was tried on both kinds
  CHECK(turned > 5000);
}

TEST_CASE("orientation: a point off the line by less than a rounding error is noticed") {
  // 0.5, 12 and 24 lie on y = x; the first is moved by one unit in the last place, 1.1e-16, either way.
  const Vec2 b(12, 12), c(24, 24);
  CHECK(orientation({0.5, 0.5}, b, c) == 0);
  CHECK(orientation({0.5, std::nextafter(0.5, 1.0)}, b, c) == 1);
  CHECK(orientation({0.5, std::nextafter(0.5, 0.0)}, b, c) == -1);
  CHECK(orientation({std::nextafter(0.5, 1.0), 0.5}, b, c) == -1);
  // 1e-17 off a line through points of size 1; no double of that size is as close to it.
  CHECK(orientation({0, 1e-17}, {0.5, 0.5}, {1, 1}) == 1);
  CHECK(orientation({0, -1e-17}, {0.5, 0.5}, {1, 1}) == -1);
  CHECK(orientation({1e-17, 1e-17}, {0.5, 0.5}, {1, 1}) == 0);
  CHECK(orientation({-1, -1}, {1, 1}, {1e-17, 0}) == -1);
}

TEST_CASE("orientation: the sign is that of 128-bit integers on points of a fine lattice") {
  Rng rng(2);
  int straight = 0;
  for (int i = 0; i < 20000; ++i) {
    std::int64_t p[3][2];
    const std::int64_t size = std::int64_t(1) << rng.range(2, 52);
    for (auto& q : p)
      for (auto& x : q) x = std::int64_t(rng.next() % std::uint64_t(2 * size)) - size;
    // Two of three times the third point is put next to the line through the others.
    if (rng.chance(0.67))
      for (int k = 0; k < 2; ++k) p[2][k] = (p[0][k] + p[1][k]) / 2 + rng.range(-1, 1);
    using Wide = __int128;
    const Wide area = Wide(p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - Wide(p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    const int expected = (area > 0) - (area < 0);
    straight += expected == 0;
    const auto point = [&](int k) { return Vec2(double(p[k][0]), double(p[k][1])); };
    REQUIRE(orientation(point(0), point(1), point(2)) == expected);
  }
  CHECK(straight > 200);
}
