// SPDX-License-Identifier: GPL-2.0-or-later
// Options by their names.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "qmorph/error.hpp"
#include "qmorph/options.hpp"

using namespace qmorph;

TEST_CASE("named options: the constants of table 4.1, angles in degrees") {
  Options options;
  set_option(options, "THETAMAX", 170);
  CHECK(options.smoothing.thesis.largest_angle == doctest::Approx(170 * std::numbers::pi / 180));
  set_option(options, "EPSILON2", 0.09 * 180);
  CHECK(options.front.seam_angle == doctest::Approx(0.09 * std::numbers::pi));
  set_option(options, "MAXITER", 7);
  CHECK(options.smoothing.thesis.most_passes == 7);
  const auto names = option_names();
  for (const char* name : {"EPSILON1", "EPSILON2", "COINCTOL", "MOVETOLERANCE", "OBSTOL", "DELTAFACTOR", "MYMIN",
                           "THETAMAX", "TOL", "GAMMA", "MAXITER"})
    CHECK(std::find(names.begin(), names.end(), name) != names.end());
  for (const std::string& name : names) {
    const bool is_angle = name.ends_with("angle") || name == "THETAMAX";
    CHECK_NOTHROW(set_option(options, name, is_angle ? 120 : name == "DELTAFACTOR" ? 1e-4 : 1));
  }
}

TEST_CASE("named options: unknown names, texts that are not numbers and values out of range are refused") {
  Options options;
  CHECK_THROWS_AS(set_option(options, "thetamax", 1), UsageError);
  CHECK_THROWS_AS(set_option(options, "MYMIN", -0.1), UsageError);
  CHECK_THROWS_AS(set_option(options, "MYMIN", std::nan("")), UsageError);
  CHECK_THROWS_AS(set_option(options, "cleanup.pattern_rounds", 1e9), UsageError);
}

TEST_CASE("named options: what was set is read back") {
  Options options;
  CHECK(get_option(options, "EPSILON2") == doctest::Approx(45));
  CHECK(get_option(options, "layers") == 1);
  CHECK(get_option(options, "part_triangles") == 120'000);
  for (const std::string& name : option_names()) {
    const double value = get_option(options, name);
    set_option(options, name, value == 0 ? 1 : value == 1 ? 0 : value * 0.75);
    CHECK_MESSAGE(get_option(options, name) != value, name);
  }
  CHECK_THROWS_AS(get_option(options, "epsilon2"), UsageError);
}
