// SPDX-License-Identifier: GPL-2.0-or-later
// How many segments each curve gets.
#include "parity/intervals.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "parity/unknowns.hpp"
#include "support/rng.hpp"

namespace {

using qmorph::Index;
using qmorph::kNone;
using qmorph::parity::Band;
using qmorph::parity::CurveWish;
using qmorph::parity::IntervalPlan;
using qmorph::parity::IntervalProblem;
using qmorph::parity::plan_intervals;
using qmorph::test::Rng;

CurveWish wish_for(double wish) {
  const int segments = int(std::ceil(wish));
  return {(wish + segments) / 2, segments, segments <= 4 ? segments : std::max(4, int(std::ceil(0.75 * segments))),
          false};
}

CurveWish random_wish(Rng& rng) {
  return wish_for(rng.chance(0.3) ? rng.uniform() * 3 + 0.01 : rng.uniform() * 40 + 0.01);
}

/// Surfaces in a grid, with a curve between neighbours and around.
IntervalProblem grid_of_surfaces(Rng& rng, int columns, int rows) {
  IntervalProblem problem;
  problem.surfaces.resize(std::size_t(columns * rows));
  const auto add = [&](int column, int row, int other_column, int other_row) {
    const auto inside = [&](int c, int r) { return c >= 0 && c < columns && r >= 0 && r < rows; };
    const Index curve = Index(problem.curves.size());
    problem.curves.push_back(random_wish(rng));
    if (inside(column, row)) problem.surfaces[std::size_t(row * columns + column)].push_back(curve);
    if (inside(other_column, other_row))
      problem.surfaces[std::size_t(other_row * columns + other_column)].push_back(curve);
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c <= columns; ++c) add(c - 1, r, c, r);
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c < columns; ++c) add(c, r - 1, c, r);
  return problem;
}

/// The faces and edges of a block of boxes: inside of it four surfaces share a curve.
IntervalProblem block_of_boxes(Rng& rng, std::array<int, 3> size) {
  IntervalProblem problem;
  std::map<std::array<int, 4>, Index> curves;  // by the first end and the direction
  const auto curve = [&](std::array<int, 3> from, int axis) {
    const auto [at, is_new] = curves.try_emplace({from[0], from[1], from[2], axis}, Index(curves.size()));
    if (is_new) problem.curves.push_back(random_wish(rng));
    return at->second;
  };
  for (int normal = 0; normal < 3; ++normal)
    for (int x = 0; x <= size[0]; ++x)
      for (int y = 0; y <= size[1]; ++y)
        for (int z = 0; z <= size[2]; ++z) {
          const int a = (normal + 1) % 3, b = (normal + 2) % 3;
          const std::array<int, 3> from{x, y, z};
          if (from[std::size_t(a)] == size[std::size_t(a)] || from[std::size_t(b)] == size[std::size_t(b)]) continue;
          std::array<int, 3> beyond_a = from, beyond_b = from;
          ++beyond_a[std::size_t(a)], ++beyond_b[std::size_t(b)];
          problem.surfaces.push_back({curve(from, a), curve(from, b), curve(beyond_b, a), curve(beyond_a, b)});
        }
  return problem;
}

int sum(const IntervalPlan& plan, const std::vector<Index>& curves) {
  int all = 0;
  for (Index c : curves) all += plan.segments[c];
  return all;
}

double harm(const IntervalProblem& problem, const std::vector<int>& segments) {
  double all = 0;
  for (Index c = 0; c < problem.curves.size(); ++c) all += qmorph::parity::harm(problem.curves[c], segments[c]);
  return all;
}

/// What must hold for every plan, whatever it is good for.
void check_plan(const IntervalProblem& problem, const IntervalPlan& plan) {
  REQUIRE(plan.segments.size() == problem.curves.size());
  for (Index c = 0; c < problem.curves.size(); ++c) {
    if (problem.curves[c].fixed)
      CHECK(plan.segments[c] == problem.curves[c].segments);
    else
      CHECK(plan.segments[c] >= problem.curves[c].least);
  }
  for (const auto& [a, b] : problem.images) CHECK(plan.segments[a] == plan.segments[b]);
  for (Index s = 0; s < problem.surfaces.size(); ++s)
    CHECK((sum(plan, problem.surfaces[s]) % 2 != 0) == (std::count(plan.odd.begin(), plan.odd.end(), s) == 1));
}

/// The least harm of all plans that change no curve by more than one, by trying all.
double least_harm(const IntervalProblem& problem) {
  std::vector<int> change(problem.curves.size(), -1);
  double best = std::numeric_limits<double>::max();
  while (true) {
    IntervalPlan plan;
    bool allowed = true;
    for (Index c = 0; c < change.size(); ++c) {
      const CurveWish& curve = problem.curves[c];
      plan.segments.push_back(curve.segments + change[c]);
      allowed = allowed && (curve.fixed ? change[c] == 0 : plan.segments[c] >= curve.least);
    }
    for (const auto& surface : problem.surfaces) allowed = allowed && sum(plan, surface) % 2 == 0;
    if (allowed) best = std::min(best, harm(problem, plan.segments));
    std::size_t at = 0;
    while (at < change.size() && change[at] == 1) change[at++] = -1;
    if (at == change.size()) return best;
    ++change[at];
  }
}

}  // namespace

TEST_CASE("intervals: in a thousand random models every surface gets an even boundary") {
  Rng rng(1);
  for (int trial = 0; trial < 1000; ++trial) {
    CAPTURE(trial);
    IntervalProblem problem = grid_of_surfaces(rng, rng.range(1, 7), rng.range(1, 7));
    if (rng.chance(0.5))  // some stay, but one at least leads to the outside
      for (std::size_t c = 1; c < problem.curves.size(); ++c) problem.curves[c].fixed = rng.chance(0.1);
    if (rng.chance(0.5))  // any sides that are no strip's at all
      for (const auto& surface : problem.surfaces)
        if (rng.chance(0.5) && surface.size() == 4)
          problem.bands.push_back({Index(&surface - problem.surfaces.data()), {surface[0]}, {surface[1]}});
    const IntervalPlan plan = plan_intervals(problem);
    check_plan(problem, plan);
    const bool any_fixed =
        std::any_of(problem.curves.begin(), problem.curves.end(), [](const CurveWish& c) { return c.fixed; });
    if (!any_fixed) CHECK(plan.odd.empty());
  }
}

TEST_CASE("intervals: surfaces that meet in space by three and four get even boundaries, too") {
  Rng rng(11);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const IntervalProblem problem = block_of_boxes(rng, {rng.range(1, 4), rng.range(1, 4), rng.range(1, 4)});
    const IntervalPlan plan = plan_intervals(problem);
    check_plan(problem, plan);
    CHECK(plan.odd.empty());
  }
}

TEST_CASE("intervals: no other plan is nearer to the wishes, on small models") {
  Rng rng(2);
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    IntervalProblem problem = grid_of_surfaces(rng, rng.range(1, 3), 1);
    if (rng.chance(0.5)) problem.curves[problem.curves.size() / 2].fixed = true;
    const IntervalPlan plan = plan_intervals(problem);
    check_plan(problem, plan);
    if (!plan.odd.empty()) continue;
    CHECK(harm(problem, plan.segments) <= doctest::Approx(least_harm(problem)).epsilon(1e-5));
  }
}

TEST_CASE("intervals: what is even already stays as it is") {
  Rng rng(3);
  IntervalProblem problem = grid_of_surfaces(rng, 4, 3);
  for (CurveWish& curve : problem.curves) curve = wish_for(10.5);  // four sides of 11 each
  const IntervalPlan plan = plan_intervals(problem);
  CHECK(std::all_of(plan.segments.begin(), plan.segments.end(), [](int n) { return n == 11; }));
}

TEST_CASE("intervals: an edge of one segment is not halved where a longer curve will do") {
  IntervalProblem problem;
  problem.curves = {wish_for(0.7), wish_for(7.2), wish_for(30.4), wish_for(2.9)};  // 1 + 8 + 31 + 3
  problem.surfaces = {{0, 1, 2, 3}};
  const IntervalPlan plan = plan_intervals(problem);
  CHECK(plan.segments == std::vector<int>{1, 8, 30, 3});
}

TEST_CASE("intervals: of two curves the one that counts for less changes") {
  for (const Index heavy : {0, 1}) {
    IntervalProblem problem;
    problem.curves = {wish_for(10.5), wish_for(9.5)};  // 11 + 10
    problem.curves[heavy].weight = 4;
    problem.surfaces = {{0, 1}};
    const IntervalPlan plan = plan_intervals(problem);
    CAPTURE(heavy);
    CHECK(plan.odd.empty());
    CHECK(plan.segments[heavy] == problem.curves[heavy].segments);
  }
}

TEST_CASE("intervals: both sides of a thin ring, and of rings around it, get the same number") {
  // Rings between circles, each of which is one curve; the innermost circle is around a disc.
  for (const int rings : {1, 2, 5}) {
    IntervalProblem problem;
    problem.surfaces = {{0}};
    for (int r = 0; r <= rings; ++r) problem.curves.push_back(wish_for(40.3 + 1.7 * r));
    for (Index r = 0; r < Index(rings); ++r) {
      problem.surfaces.push_back({r, r + 1});
      problem.bands.push_back({r + 1, {r}, {r + 1}});
    }
    const IntervalPlan plan = plan_intervals(problem);
    check_plan(problem, plan);
    CHECK(plan.odd.empty());
    CHECK(plan.fitting == std::size_t(rings));
  }
}

TEST_CASE("intervals: sides of several curves get the same sums, and keep them when parities are mended") {
  Rng rng(4);
  std::size_t bands = 0, fitting = 0;
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    // A strip whose sides are cut at other places; beyond each piece of a side lies a surface with free curves.
    IntervalProblem problem;
    const double length = 20 + 40 * rng.uniform();
    Band band{0, {}, {}};
    problem.surfaces = {{}};
    for (std::vector<Index>* side : {&band.one, &band.other}) {
      const int pieces = rng.range(1, 4);
      for (int p = 0; p < pieces; ++p) {
        const Index curve = Index(problem.curves.size());
        problem.curves.push_back(wish_for(length / pieces));
        problem.curves.push_back(wish_for(5 + 10 * rng.uniform()));
        side->push_back(curve);
        problem.surfaces[0].push_back(curve);
        problem.surfaces.push_back({curve, curve + 1});
      }
    }
    for (int end = 0; end < 2; ++end) {
      problem.surfaces[0].push_back(Index(problem.curves.size()));
      problem.curves.push_back(wish_for(0.9));
    }
    problem.bands.push_back(band);
    const IntervalPlan plan = plan_intervals(problem);
    check_plan(problem, plan);
    CHECK(plan.odd.empty());
    ++bands, fitting += sum(plan, band.one) == sum(plan, band.other);
  }
  CHECK(fitting == bands);
}

TEST_CASE("intervals: periodic images keep equal numbers, whatever lies between them") {
  Rng rng(5);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    IntervalProblem problem = grid_of_surfaces(rng, 3, 3);
    // The left and the right side of the cell.
    for (Index r = 0; r < 3; ++r) {
      problem.curves[4 * r + 3] = problem.curves[4 * r];
      problem.images.emplace_back(4 * r, 4 * r + 3);
    }
    const IntervalPlan plan = plan_intervals(problem);
    check_plan(problem, plan);
    CHECK(plan.odd.empty());
  }
}

TEST_CASE("intervals: where a band leaves a surface odd, it is given up") {
  // Four sides between two surfaces, each with another curve whose number is fixed: odd on one side, even on the other.
  IntervalProblem problem;
  problem.curves = {wish_for(5), wish_for(4), wish_for(4), wish_for(6), wish_for(6), wish_for(4)};
  problem.curves[0].fixed = problem.curves[5].fixed = true;
  problem.surfaces = {{0, 1}, {1, 2, 3, 4}, {2, 5}};
  problem.bands = {{1, {1}, {2}}, {1, {3}, {4}}};
  const IntervalPlan plan = plan_intervals(problem);
  CHECK(plan.odd.empty());
  CHECK(plan.segments[0] == 5);
  CHECK(plan.segments[5] == 4);
  CHECK(plan.segments[1] % 2 == 1);
  CHECK(plan.segments[2] == 4);
}

TEST_CASE("intervals: a surface that no number may change for stays odd, and is named") {
  IntervalProblem problem;
  problem.curves = {{3, 3, 3, true}, {4, 4, 4, true}, {5.9, 6, 5, false}};
  problem.surfaces = {{0, 1}, {1, 2}};
  const IntervalPlan plan = plan_intervals(problem);
  CHECK(plan.odd == std::vector<Index>{0});
}
