// SPDX-License-Identifier: GPL-2.0-or-later
// Rows of quads between two rails.
#include "cleanup/band_plan.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

namespace {

using namespace qmorph;
using cleanup::BandPlan;
using cleanup::plan_band;

constexpr int kSpareLag = 4;

/// Nodes at height y, one apart, from x = first on.
std::vector<Vec2> rail(int count, double first, double y) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) points.emplace_back(first + i, y);
  return points;
}

std::size_t places_in_two_rows(const BandPlan& plan) {
  return std::size_t(std::count_if(plan.places.begin(), plan.places.end(), [](const auto& p) { return p.two_rows; }));
}

/// From the first nodes to the last; each step goes one edge ahead on both rails or, where rows begin or end, on one.
void check_is_complete(const BandPlan& plan, std::size_t lower, std::size_t upper) {
  REQUIRE(plan.places.size() >= 2);
  CHECK(plan.places.front().lower == 0);
  CHECK(plan.places.front().upper == 0);
  CHECK_FALSE(plan.places.front().two_rows);
  CHECK(plan.places.back().lower == lower - 1);
  CHECK(plan.places.back().upper == upper - 1);
  CHECK_FALSE(plan.places.back().two_rows);
  for (std::size_t k = 1; k < plan.places.size(); ++k) {
    const auto &from = plan.places[k - 1], &to = plan.places[k];
    const auto edges = to.lower - from.lower + to.upper - from.upper;
    CHECK(edges == (from.two_rows == to.two_rows ? 2 : 1));
    if (from.two_rows == to.two_rows) CHECK(to.lower == from.lower + 1);
  }
}

}  // namespace

TEST_CASE("band plan: straight rails that face each other have single rungs only, at no cost") {
  const BandPlan plan = plan_band(rail(9, 0, 0), rail(9, 0, 1), kSpareLag);
  check_is_complete(plan, 9, 9);
  CHECK(plan.places.size() == 9);
  CHECK(places_in_two_rows(plan) == 0);
  CHECK(plan.cost == doctest::Approx(0));
  for (const auto& place : plan.places) CHECK(place.lower == place.upper);
}

TEST_CASE(
    "band plan: where long rails are shifted by an edge, two rows take up the lean in the middle or at the ends") {
  for (double shift : {1.0, -1.0}) {
    const BandPlan plan = plan_band(rail(20, 0, 0), rail(20, shift, 1), kSpareLag);
    check_is_complete(plan, 20, 20);
    CHECK(places_in_two_rows(plan) > 0);
    const BandPlan leaning = plan_band(rail(20, 0, 0), rail(20, shift, 1), 0);
    CHECK(places_in_two_rows(leaning) == 0);
    CHECK(plan.cost < leaning.cost);
  }
}

TEST_CASE("band plan: a lean that is not worth two irregular nodes stays") {
  const BandPlan plan = plan_band(rail(20, 0, 0), rail(20, 0.1, 1), kSpareLag);
  check_is_complete(plan, 20, 20);
  CHECK(places_in_two_rows(plan) == 0);
}

TEST_CASE("band plan: rails whose numbers of edges differ by an even number are joined") {
  std::vector<Vec2> upper;
  for (int i = 0; i < 13; ++i) upper.emplace_back(10.0 * i / 12, 1);
  const BandPlan plan = plan_band(rail(11, 0, 0), upper, kSpareLag);
  check_is_complete(plan, 11, 13);
  CHECK(places_in_two_rows(plan) > 0);
}

TEST_CASE("band plan: there is none if the numbers of edges differ by an odd number or by more than the lag") {
  CHECK(plan_band(rail(8, 0, 0), rail(9, 0, 1), kSpareLag).places.empty());
  CHECK(plan_band(rail(8, 0, 0), rail(14, 0, 1), kSpareLag).places.empty());
}
