// SPDX-License-Identifier: GPL-2.0-or-later
// Progress of a conversion: what is told, and how a callback ends the work.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "qmorph/convert.hpp"
#include "support/domains.hpp"

namespace {

using namespace qmorph;

std::vector<Patch> some_patches() {
  std::vector<Patch> patches;
  for (std::uint64_t seed = 0; seed < 12; ++seed) patches.push_back(test::random_domain(seed).patch);
  return patches;
}

std::vector<const Patch*> pointers(const std::vector<Patch>& patches) {
  std::vector<const Patch*> all;
  for (const Patch& patch : patches) all.push_back(&patch);
  return all;
}

/// Does `act` at its n-th call.
ProgressCallback at_call(int n, std::atomic<int>& calls, const std::function<Progress()>& act) {
  return [n, &calls, act](std::string_view, double) { return ++calls < n ? Progress::go_on : act(); };
}

}  // namespace

TEST_CASE("progress: shares grow from 0 to 1, and listening changes nothing") {
  const Patch patch = test::random_domain(3).patch;
  std::vector<double> shares;
  Options options;
  options.progress = [&](std::string_view stage, double share) {
    CHECK_FALSE(stage.empty());
    shares.push_back(share);
    return Progress::go_on;
  };
  const QuadMesh mesh = convert(patch, options).mesh;
  REQUIRE_FALSE(shares.empty());
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.front() >= 0);
  CHECK(shares.back() == doctest::Approx(1));
  CHECK(mesh.points == convert(patch).mesh.points);
}

TEST_CASE("progress: cancelling throws Cancelled, wherever the work is, on one thread and on many") {
  const std::vector<Patch> patches = some_patches();
  for (int threads : {1, 0})
    for (int n = 1; n < 20; n += 3) {
      CAPTURE(n);
      std::atomic<int> calls = 0;
      Options options;
      options.threads = threads;
      options.progress = at_call(n, calls, [] { return Progress::cancel; });
      CHECK_THROWS_AS(convert_all(pointers(patches), options), Cancelled);
      CHECK(calls == n);  // nobody is asked again
      calls = 0;
      CHECK_THROWS_AS(improve_all(pointers(patches), options), Cancelled);
    }
  Options options;
  options.progress = [](std::string_view, double) { return Progress::cancel; };
  CHECK_THROWS_AS(convert(patches[3], options), Cancelled);
  CHECK_THROWS_AS(improve(patches[3], options), Cancelled);
  options.part_triangles = 80;
  CHECK_THROWS_AS(convert(patches[3], options), Cancelled);
}

TEST_CASE("progress: what a callback throws comes out as it is, even an error of our own family") {
  const std::vector<Patch> patches = some_patches();
  for (int threads : {1, 0})
    for (int n = 1; n < 20; n += 3) {
      CAPTURE(n);
      std::atomic<int> calls = 0;
      Options options;
      options.threads = threads;
      options.progress = at_call(n, calls, []() -> Progress { throw std::range_error("mine"); });
      CHECK_THROWS_WITH_AS(convert_all(pointers(patches), options), "mine", std::range_error);
      CHECK(calls == n);
      calls = 0;
      options.progress = at_call(n, calls, []() -> Progress { throw SurfaceError("mine, too"); });
      CHECK_THROWS_WITH_AS(convert_all(pointers(patches), options), "mine, too", SurfaceError);
    }
}
