// SPDX-License-Identifier: GPL-2.0-or-later
// Work is counted, never timed: what a call may cost is kept, whatever it is given.
#include "engine/budget.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <mutex>

#include "engine/surface.hpp"
#include "support/rng.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

/// Triangles of a unit square, `n` times `n` cells, whose nodes inside are off the grid.
Patch uneven(Index n, Rng& rng) {
  constexpr double kJitter = 0.3;  // of a cell
  Patch patch;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      const auto shift = [&] { return inside ? rng.between(-kJitter, kJitter) : 0; };
      const double x = (i + shift()) / n, y = (j + shift()) / n;
      patch.points.emplace_back(x, y, 0);
    }
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      if (rng.chance(0.5)) {
        patch.triangles.push_back({a, b, c});
        patch.triangles.push_back({a, c, d});
      } else {
        patch.triangles.push_back({a, b, d});
        patch.triangles.push_back({b, c, d});
      }
    }
  return patch;
}

/// Its triangles shared out among surfaces with ragged outlines, each to the nearest of `count` places.
std::vector<Patch> ragged(const Patch& patch, std::size_t count, Rng& rng) {
  std::vector<Eigen::Vector3d> places;
  for (std::size_t k = 0; k < count; ++k) places.emplace_back(rng.uniform(), rng.uniform(), 0);
  std::vector<Patch> parts(count);
  std::vector<std::vector<Index>> row(count, std::vector<Index>(patch.points.size(), kNone));
  for (const auto& [a, b, c] : patch.triangles) {
    const Eigen::Vector3d centre = (patch.points[a] + patch.points[b] + patch.points[c]) / 3;
    const auto nearer = [&](const auto& p, const auto& q) { return (p - centre).norm() < (q - centre).norm(); };
    const std::size_t k = std::size_t(std::min_element(places.begin(), places.end(), nearer) - places.begin());
    const auto own = [&](Index v) {
      if (row[k][v] == kNone) row[k][v] = Index(parts[k].points.size()), parts[k].points.push_back(patch.points[v]);
      return row[k][v];
    };
    const Index u = own(a), v = own(b), w = own(c);
    parts[k].triangles.push_back({u, v, w});
  }
  std::erase_if(parts, [](const Patch& part) { return part.triangles.empty(); });
  return parts;
}

struct Run {
  std::vector<Outcome> outcomes;
  double spent = 0;
};

/// convert_all() for about so much work.
Run convert_for(const std::vector<Patch>& patches, double allowed, int threads) {
  std::vector<const Patch*> pointers;
  for (const Patch& patch : patches) pointers.push_back(&patch);
  Options options;
  options.threads = threads;
  Run run;
  std::mutex mutex;
  run.outcomes = work_on_patches(
      pointers, options,
      [&](const Patch& patch, const Options& own, Budget& budget) {
        SurfaceWork result = convert_patch(patch, own, budget);
        const std::lock_guard lock(mutex);
        run.spent += budget.spent();
        return result;
      },
      allowed);
  return run;
}

/// What a try has begun it finishes, and for what makes elements valid nothing need be left.
double most_of(double each) {
  constexpr double kOverdraft = 1.25, kForValidity = 400;
  return kOverdraft * each + kForValidity;
}

std::size_t triangles_of(const std::vector<Patch>& patches) {
  std::size_t count = 0;
  for (const Patch& patch : patches) count += patch.triangles.size();
  return count;
}

}  // namespace

TEST_CASE("budget: what shares leave is for those that were cut short, most often first, twice what they had") {
  std::vector<Budget> shares(4, Budget(100));
  shares[0] = Budget(210);
  for (std::size_t i : {1, 2, 3}) shares[i].spend(100);
  CHECK(share_out_the_rest(shares, {0, 1, 3, 0}) == std::vector<std::size_t>{2});  // there is enough for one
  CHECK(shares[2].left() == 200);
  CHECK(shares[2].spent() == 100);
  CHECK(shares[1].left() == 0);
  CHECK(share_out_the_rest(shares, {0, 0, 0, 0}).empty());
}

TEST_CASE("budget: of a call it is in proportion to its triangles, and few may cost more") {
  CHECK(budget_of_call(100'000) == doctest::Approx(10 * budget_of_call(10'000)));
  constexpr double kRounding = 1e-12;
  double before = std::numeric_limits<double>::max();
  for (double n = 100; n < 1e6; n *= 1.3) {
    const double each = budget_of_call(n) / n;
    CHECK(each <= before * (1 + kRounding));
    before = each;
  }
  // Ordinary surfaces of a small call get all that they are worth.
  for (std::size_t n : {10u, 100u, 1000u, 2000u}) CHECK(budget_of_call(double(n)) >= allowance(n));
}

TEST_CASE("budget: shares add up to what is allowed") {
  const std::vector<double> sizes{1, 5, 20, 20, 3000};
  double all = 0, shares = 0;
  for (double size : sizes) all += size;
  for (double size : sizes) shares += share_of(7e6, size, all, sizes.size());
  CHECK(shares == doctest::Approx(7e6));
}

TEST_CASE("budget: what came of shares is spent from the whole, though something was thrown") {
  Budget whole(100);
  std::vector<Budget> shares(2, Budget(50));
  try {
    const SpentInAll spent_in_all(whole, shares);
    shares[0].spend(30), shares[1].spend(40);
    throw 1;
  } catch (int) {
  }
  CHECK(whole.left() == doctest::Approx(30));
  CHECK(whole.left_for_another() == doctest::Approx(30));
  whole.spend(60);
  CHECK(whole.is_spent());
  CHECK(whole.left_for_another() > 0);
}

TEST_CASE("budget: many ragged surfaces cost what is allowed and little more, on any number of threads") {
  Rng rng(41);
  const std::vector<Patch> patches = ragged(uneven(14, rng), 18, rng);
  const double triangles = double(triangles_of(patches));
  double before = 0;
  for (const double each : {200.0, 1000.0, 4000.0}) {
    CAPTURE(each);
    const Run one = convert_for(patches, each * triangles, 1), two = convert_for(patches, each * triangles, 2);
    CHECK(one.spent <= most_of(each) * triangles);
    CHECK(one.spent > before);
    before = one.spent;
    CHECK(one.spent == doctest::Approx(two.spent));
    for (std::size_t i = 0; i < patches.size(); ++i) {
      REQUIRE(one.outcomes[i].conversion);
      REQUIRE(two.outcomes[i].conversion);
      const QuadMesh &first = one.outcomes[i].conversion->mesh, &second = two.outcomes[i].conversion->mesh;
      CHECK(first.points == second.points);
      CHECK(first.quads == second.quads);
      CHECK(first.triangles == second.triangles);
    }
  }
}

TEST_CASE("budget: a surface whose nodes are all fixed costs what is allowed and little more") {
  Rng rng(42);
  std::vector<Patch> patches{uneven(16, rng)};
  for (Index v = 0; v < patches[0].points.size(); ++v) patches[0].fixed.push_back(v);
  const double triangles = double(triangles_of(patches)), each = 600;
  const Run run = convert_for(patches, each * triangles, 1);
  REQUIRE(run.outcomes[0].conversion);
  CHECK(run.outcomes[0].conversion->mesh.triangles.empty());
  CHECK(run.outcomes[0].conversion->report.budgets_spent > 0);
  CHECK(run.spent <= most_of(each) * triangles);
}
