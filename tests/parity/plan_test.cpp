// SPDX-License-Identifier: GPL-2.0-or-later
// Which edges get a node so that all regions become even.
#include "parity/plan.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "parity/matching.hpp"
#include "support/rng.hpp"

namespace {

using qmorph::Index;
using qmorph::parity::Cost;
using qmorph::parity::CostTable;
using qmorph::parity::kOutside;
using qmorph::parity::Link;
using qmorph::parity::Plan;
using qmorph::parity::plan_splits;
using qmorph::test::Rng;

/// By all subsets.
Cost cheapest_by_table(const CostTable& costs) {
  const std::size_t n = costs.size();
  std::vector<Cost> best(std::size_t{1} << n, std::numeric_limits<Cost>::max());
  best[0] = 0;
  for (std::size_t set = 0; set + 1 < best.size(); ++set) {
    if (best[set] == std::numeric_limits<Cost>::max()) continue;
    std::size_t i = 0;
    while (set >> i & 1) ++i;
    for (std::size_t j = i + 1; j < n; ++j) {
      if (set >> j & 1) continue;
      Cost& there = best[set | std::size_t{1} << i | std::size_t{1} << j];
      there = std::min(there, best[set] + costs(i, j));
    }
  }
  return best.back();
}

Cost cost_of(const CostTable& costs, const std::vector<Index>& mate) {
  Cost sum = 0;
  for (Index i = 0; i < mate.size(); ++i) {
    REQUIRE(mate[i] < mate.size());
    REQUIRE(mate[mate[i]] == i);
    REQUIRE(mate[i] != i);
    if (i < mate[i]) sum += costs(i, mate[i]);
  }
  return sum;
}

std::vector<bool> parity_after(std::vector<bool> odd, const std::vector<Link>& links, const Plan& plan) {
  for (Index i : plan.splits) {
    for (Index r : {links[i].a, links[i].b})
      if (r != kOutside) odd[r] = !odd[r];
    for (Index r : links[i].others) odd[r] = !odd[r];
  }
  return odd;
}

std::size_t count_odd(const std::vector<bool>& odd) { return std::size_t(std::count(odd.begin(), odd.end(), true)); }

/// The fewest splits that leave the fewest odd regions, by all subsets of the links.
std::pair<std::size_t, std::size_t> fewest_by_trial(const std::vector<bool>& odd, const std::vector<Link>& links) {
  std::pair<std::size_t, std::size_t> best{odd.size() + 1, 0};
  for (std::size_t set = 0; set < std::size_t{1} << links.size(); ++set) {
    Plan plan;
    for (Index i = 0; i < links.size(); ++i)
      if (set >> i & 1) plan.splits.push_back(i);
    best = std::min(best, {count_odd(parity_after(odd, links, plan)), plan.splits.size()});
  }
  return best;
}

}  // namespace

TEST_CASE("matching: the cost is that of the best of all matchings") {
  Rng rng(1);
  for (int trial = 0; trial < 3000; ++trial) {
    CAPTURE(trial);
    const auto size = std::size_t(2 * rng.range(1, 6));
    const int most = rng.pick(std::vector<int>{1, 2, 5, 20, 1000});
    CostTable costs(size);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = i + 1; j < size; ++j) costs.set(i, j, rng.range(0, most));
    if (rng.chance(0.5)) {  // odd clusters, near to themselves and far from one another: blossoms in blossoms
      for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = i + 1; j < size; ++j) costs.set(i, j, costs(i, j) + (i / 3 == j / 3 ? 0 : 2 * most));
    }
    CHECK(cost_of(costs, qmorph::parity::cheapest_matching(costs)) == cheapest_by_table(costs));
  }
}

TEST_CASE("matching: of points in the plane, near and many") {
  Rng rng(2);
  for (const std::size_t size : {14u, 16u}) {
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<std::pair<double, double>> points;
      for (std::size_t i = 0; i < size; ++i) points.emplace_back(rng.uniform(), rng.uniform());
      CostTable costs(size);
      for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = i + 1; j < size; ++j)
          costs.set(i, j,
                    Cost(1e9 * std::hypot(points[i].first - points[j].first, points[i].second - points[j].second)));
      CHECK(cost_of(costs, qmorph::parity::cheapest_matching(costs)) == cheapest_by_table(costs));
    }
  }
  CostTable many(120);
  for (std::size_t i = 0; i < many.size(); ++i)
    for (std::size_t j = i + 1; j < many.size(); ++j) many.set(i, j, rng.range(0, 100000));
  cost_of(many, qmorph::parity::cheapest_matching(many));
}

TEST_CASE("plan: neighbours share one split, and one alone goes to the outside by its longest edge") {
  //  0 | 1 | 2   in a row, each with an edge to the outside
  const std::vector<Link> links = {
      {0, 1, 1.0}, {1, 2, 1.0}, {0, kOutside, 1.0}, {0, kOutside, 3.0}, {2, kOutside, 1.0}};
  CHECK(plan_splits({true, true, false}, links).splits == std::vector<Index>{0});
  CHECK(plan_splits({true, false, false}, links).splits == std::vector<Index>{3});
  CHECK(plan_splits({true, false, true}, links).splits.size() == 2);
  CHECK(plan_splits({false, false, false}, links).splits.empty());
}

TEST_CASE("plan: long edges are preferred, but never at the price of another split") {
  const std::vector<Link> links = {{0, 1, 0.001}, {0, 2, 10}, {2, 1, 10}, {0, 3, 1}, {3, 1, 1}};
  CHECK(plan_splits({true, true, false, false}, links).splits == std::vector<Index>{0});
  const std::vector<Link> detours(links.begin() + 1, links.end());
  CHECK(plan_splits({true, true, false, false}, detours).splits == std::vector<Index>{0, 1});
}

TEST_CASE("plan: edges that are split together are counted one by one") {
  const std::vector<Link> links = {{0, 1, 5, 3}, {0, 2, 1}, {2, 1, 1}, {0, kOutside, 9, 2}};
  CHECK(plan_splits({true, true, false}, links).splits == std::vector<Index>{1, 2});
  CHECK(plan_splits({true, false, false}, links).splits == std::vector<Index>{3});
  const std::vector<Link> cheaper = {{0, 1, 5, 2}, {0, 1, 1, 1}};
  CHECK(plan_splits({true, true}, cheaper).splits == std::vector<Index>{1});
}

TEST_CASE("plan: where no edge may be split, one region stays odd and is named") {
  const std::vector<Link> links = {{0, 1, 1}, {1, 2, 1}, {3, 3, 1}};
  const Plan plan = plan_splits({true, true, true, true}, links);
  CHECK(plan.splits.size() == 1);
  CHECK(plan.odd_left.size() == 2);
  CHECK(plan.odd_left.back() == 3);
}

TEST_CASE("plan: as few splits as the best of all sets of links, on random graphs") {
  Rng rng(3);
  for (int trial = 0; trial < 400; ++trial) {
    CAPTURE(trial);
    const auto regions = Index(rng.range(1, 8));
    std::vector<Link> links;
    for (int i = rng.range(0, 12); i > 0; --i) {
      const auto a = Index(rng.below(regions)), b = Index(rng.below(regions + rng.below(2)));
      links.push_back({a, b == regions ? kOutside : b, rng.between(0.1, 2)});
    }
    std::vector<bool> odd;
    for (Index r = 0; r < regions; ++r) odd.push_back(rng.chance(0.6));
    const Plan plan = plan_splits(odd, links);
    const auto left = parity_after(odd, links, plan);
    CHECK(std::pair(count_odd(left), plan.splits.size()) == fewest_by_trial(odd, links));
    CHECK(plan.odd_left.size() == count_odd(left));
    for (Index r : plan.odd_left) CHECK(left[r]);
  }
}

TEST_CASE("plan: edges that three regions share are split where that makes all regions even, on random models") {
  Rng rng(7);
  int solved = 0, in_vain = 0;
  for (int trial = 0; trial < 500; ++trial) {
    CAPTURE(trial);
    const Index regions = Index(rng.range(3, 8));
    std::vector<bool> odd;
    for (Index r = 0; r < regions; ++r) odd.push_back(rng.chance(0.5));
    std::vector<Link> links;
    for (int i = rng.range(1, 9); i > 0; --i) {
      std::vector<Index> all;
      for (Index r = 0; r < regions; ++r)
        if (rng.chance(0.4)) all.push_back(r);
      if (all.size() < 2) continue;
      links.push_back({all[0], all[1], rng.uniform(), 1, {all.begin() + 2, all.end()}});
    }
    const Plan plan = plan_splits(odd, links);
    const std::vector<bool> after = parity_after(odd, links, plan);
    for (Index r = 0; r < regions; ++r)
      CHECK(after[r] == (std::count(plan.odd_left.begin(), plan.odd_left.end(), r) == 1));
    const bool can_be_even = fewest_by_trial(odd, links).first == 0;
    CHECK((count_odd(after) == 0) == can_be_even);
    (can_be_even ? solved : in_vain) += count_odd(odd) > 0;
  }
  CHECK(solved > 50);
  CHECK(in_vain > 50);
}

TEST_CASE("plan: an edge that three regions share is not split where others are enough") {
  const std::vector<Link> links = {{0, 1, 9, 1, {2}}, {0, 1, 1}, {1, 2, 1}};
  CHECK(plan_splits({true, false, true}, links).splits == std::vector<Index>{1, 2});
  CHECK(plan_splits({true, true, true}, links).splits == std::vector<Index>{0});
}
