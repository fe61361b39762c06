// SPDX-License-Identifier: GPL-2.0-or-later
// What an observer is told of a conversion as a whole: the surface after each stage, the fronts that led there.
#include <doctest/doctest.h>

#include <algorithm>
#include <stdexcept>

#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"
#include "support/domains.hpp"
#include "support/halves.hpp"
#include "support/watcher.hpp"

namespace {

using namespace qmorph;
using test::random_domain;
using test::Watcher;

Conversion convert_watched(const Patch& patch, Watcher& watcher, bool layers = true) {
  Options options;
  options.observer = &watcher;
  options.layers = layers;
  return convert(patch, options);
}

bool is_same(const QuadMesh& a, const QuadMesh& b) {
  return a.points == b.points && a.quads == b.quads && a.triangles == b.triangles && a.source == b.source;
}

}  // namespace

TEST_CASE("stages: the first is the input and the last is the result") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const Patch patch = random_domain(seed).patch;
    Watcher watcher;
    const QuadMesh mesh = convert_watched(patch, watcher).mesh;
    REQUIRE(watcher.stages.size() == kStages);
    for (std::size_t i = 0; i < kStages; ++i) CHECK(watcher.stages[i].stage == Stage(i));
    CHECK(watcher.stages.front().mesh.triangles.size() == patch.triangles.size());
    CHECK(watcher.stages.front().mesh.quads.size() == patch.quads.size());
    CHECK(is_same(watcher.stages.back().mesh, mesh));
    CHECK(watcher.stages.front().size_ratios.empty());
    CHECK(std::all_of(watcher.stages.back().size_ratios.begin(), watcher.stages.back().size_ratios.end(),
                      [](double ratio) { return ratio > 0; }));
  }
}

TEST_CASE("stages: of a grid, which no front goes through, the triangles come first and then the cells") {
  constexpr Index kCells = 8;
  for (const bool is_bent : {false, true})
    for (const double lean : {0.0, 0.5}) {
      CAPTURE(is_bent);
      CAPTURE(lean);
      Patch patch;
      for (Index j = 0; j <= kCells; ++j)
        for (Index i = 0; i <= kCells; ++i) {
          const double x = i + lean * j, y = j;
          patch.points.emplace_back(x, y, is_bent ? 0.02 * x * x : 0.0);
        }
      for (Index j = 0; j < kCells; ++j)
        for (Index i = 0; i < kCells; ++i) {
          const Index v = j * (kCells + 1) + i;
          test::add_halves(patch, {v, v + 1, v + kCells + 2, v + kCells + 1}, (i + j) % 2 == 0);
        }
      Watcher watcher;
      const QuadMesh mesh = convert_watched(patch, watcher).mesh;
      CHECK(mesh.quads.size() == kCells * kCells);
      REQUIRE(watcher.stages.size() == kStages);
      CHECK(watcher.stages.front().mesh.triangles.size() == patch.triangles.size());
      for (std::size_t i = 1; i < kStages; ++i) CHECK(watcher.stages[i].mesh.quads.size() == kCells * kCells);
      CHECK(is_same(watcher.stages.back().mesh, mesh));
    }
}

TEST_CASE("stages: watching changes no result") {
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    const Patch patch = random_domain(seed).patch;
    Watcher watcher;
    CHECK(is_same(convert_watched(patch, watcher).mesh, convert(patch).mesh));
  }
}

TEST_CASE("stages: the front leaves what elimination joins") {
  Watcher watcher;
  const auto [mesh, report] = convert_watched(random_domain(3).patch, watcher);
  const auto after = [&](Stage stage) { return watcher.stages[std::size_t(stage)].mesh; };
  CHECK(after(Stage::front).quads.size() == report.front_quads);
  CHECK(after(Stage::front).triangles.size() == report.leftover_triangles);
  CHECK(after(Stage::elimination).triangles.size() <= report.odd_regions);
}

TEST_CASE("stages: surfaces are reported under their numbers, in order, and those that failed not at all") {
  std::vector<Patch> patches;
  for (std::uint64_t seed = 0; seed < 5; ++seed) patches.push_back(random_domain(seed).patch);
  patches[2].points[0].x() = std::nan("");
  std::vector<const Patch*> all;
  for (const Patch& patch : patches) all.push_back(&patch);
  Watcher watcher;
  Options options;
  options.observer = &watcher;
  options.layers = false;  // between layers a region may have several fronts
  const std::vector<Outcome> outcomes = convert_all(all, options);
  REQUIRE(watcher.stages.size() == 4 * kStages);
  std::size_t at = 0;
  for (std::size_t i : {0, 1, 3, 4})
    for (std::size_t stage = 0; stage < kStages; ++stage, ++at) CHECK(watcher.stages[at].surface == i);
  for (const Watcher::FrontNote& front : watcher.fronts) {
    CHECK(front.surface != 2);
    CHECK(front.surface == front.player().surface);
  }
  for (std::size_t i : {0, 1, 3, 4})
    CHECK(std::count_if(watcher.fronts.begin(), watcher.fronts.end(), [&](const Watcher::FrontNote& front) {
            return front.surface == i;
          }) == int(outcomes[i].conversion->report.regions));
}

TEST_CASE("stages: fronts of rejected tries are not kept") {
  int started = 0, kept = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Watcher watcher;
    // Between layers a region may have several fronts.
    const Conversion conversion = convert_watched(random_domain(seed).patch, watcher, false);
    CHECK(watcher.fronts.size() <= conversion.report.regions);
    std::size_t quads = 0;
    for (const Watcher::FrontNote& front : watcher.fronts)
      for (const auto& face : front.player().faces) quads += face[0] != kNone && face[3] != kNone;
    CHECK(quads == conversion.report.front_quads);
    started += watcher.started, kept += int(watcher.fronts.size());
  }
  CHECK(kept < started);
}

TEST_CASE("stages: parts of a large region have a front each") {
  Watcher watcher;
  Options options;
  options.part_triangles = 80;
  options.observer = &watcher;
  std::size_t fronts = 0, regions = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) regions += convert(random_domain(seed).patch, options).report.regions;
  fronts = watcher.fronts.size();
  CHECK(fronts > regions);
  for (const Watcher::FrontNote& front : watcher.fronts) CHECK(front.surface == 0);
}

TEST_CASE("stages: what an observer throws comes out") {
  struct Thrower : Observer {
    std::unique_ptr<FrontObserver> front_starts(const FrontStart&) override { throw std::domain_error("enough"); }
  };
  Thrower thrower;
  Options options;
  options.observer = &thrower;
  CHECK_THROWS_WITH_AS(convert(random_domain(1).patch, options), "enough", std::domain_error);
}
