// SPDX-License-Identifier: GPL-2.0-or-later
// Metrics of a plane.
#include "stretch/log_metric.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/rng.hpp"

using namespace qmorph;
using stretch::LogMetric;
using stretch::metric_of;

namespace {

/// Of a triangle that is equilateral, once lengths along this direction are divided by the stretch.
LogMetric stretched(double angle, double stretch, double turn) {
  std::array<Vec2, 3> sides;
  for (int i = 0; i < 3; ++i) {
    Vec2 side = rotated(Vec2(1, 0), turn + 2 * std::numbers::pi / 3 * i);
    side.x() *= stretch;
    sides[std::size_t(i)] = rotated(side, angle);
  }
  return *metric_of(sides[0], sides[1], sides[2]);
}

}  // namespace

TEST_CASE("by the metric of a triangle, all its sides are 1") {
  test::Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const Vec2 a(rng.between(-1, 1), rng.between(-1, 1)), b(rng.between(-1, 1), rng.between(-1, 1));
    const Vec2 c = -a - b;
    const auto metric = metric_of(a, b, c);
    REQUIRE(metric);
    for (const Vec2& side : {a, b, c}) {
      CHECK(metric->length(side) == doctest::Approx(1).epsilon(1e-6));
      CHECK((metric->unstretch() * side).norm() == doctest::Approx(1).epsilon(1e-6));
    }
  }
}

TEST_CASE("a triangle without area has no metric") {
  CHECK(!metric_of(Vec2(1, 0), Vec2(1, 0), Vec2(-2, 0)));
  CHECK(!metric_of(Vec2(0, 0), Vec2(0, 0), Vec2(0, 0)));
}

TEST_CASE("a metric knows ratio and direction, up to a million to one") {
  for (const double ratio : {1.5, 30.0, 1e6})
    for (const double angle : {0.0, 0.4, 2.0}) {
      const LogMetric metric = stretched(angle, ratio, 0.3);
      CHECK(metric.ratio() == doctest::Approx(ratio).epsilon(1e-6));
      CHECK(metric.length(rotated(Vec2(ratio, 0), angle)) == doctest::Approx(1).epsilon(1e-3));
      CHECK(metric.length(rotated(Vec2(0, 1), angle)) == doctest::Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("the mean of metrics that are stretched across each other is not stretched, of others it is in between") {
  LogMetric sum = stretched(0, 10, 0);
  sum += stretched(std::numbers::pi / 2, 10, 0.7);
  CHECK((sum * 0.5).ratio() == doctest::Approx(1));
  LogMetric same = stretched(0.2, 4, 0);
  same += stretched(0.2, 16, 1);
  CHECK((same * 0.5).ratio() == doctest::Approx(8));
}
