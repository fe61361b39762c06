// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/describe.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <set>

using qmorph::describe;

TEST_CASE("describe: six digits where the origin is near") {
  CHECK(describe({1.5, -2, 0}) == "(1.5, -2, 0)");
  CHECK(describe({1.0 / 3, 0.25, 1e-20}) == "(0.333333, 0.25, 0)");
  CHECK(describe({2e-9, 0, 1e-9}) == "(2e-09, 0, 1e-09)");
}

TEST_CASE("describe: far from the origin, neighbouring points are written differently") {
  const Eigen::Vector3d corner(500123.25, 4649776.5, 312.125);  // metres, as on a map
  CHECK(describe(corner) == "(500123.25, 4649776.5, 312.125)");
  std::set<std::string> names;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j) names.insert(describe(corner + Eigen::Vector3d(1e-3 * i, 1e-3 * j, 0)));
  CHECK(names.size() == 100 * 100);
}

TEST_CASE("describe: coordinates that are not numbers") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  CHECK(describe({1, nan, 0}) == "(1, nan, 0)");
  CHECK(describe({1, 0, infinite}).find("inf") != std::string::npos);
}
