// SPDX-License-Identifier: GPL-2.0-or-later
// What comes out does not depend on the number of threads.
#include <doctest/doctest.h>

#include <cmath>

#include "qmorph/convert.hpp"
#include "support/domains.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

bool is_same(const QuadMesh& a, const QuadMesh& b) {
  return a.points == b.points && a.quads == b.quads && a.triangles == b.triangles && a.source == b.source;
}

QuadMesh convert_on(int threads, const Patch& patch) {
  Options options;
  options.threads = threads;
  return convert(patch, options).mesh;
}

/// A sheet large enough for smoothing to cut it into several blocks, whose rows lean to and fro.
Patch sheet(Index cells) {
  Patch patch;
  for (Index y = 0; y <= cells; ++y)
    for (Index x = 0; x <= cells; ++x) {
      const bool inside = x > 0 && y > 0 && x < cells && y < cells;
      patch.points.emplace_back(x + (inside ? 0.3 * std::sin(7.0 * y + x) : 0),
                                y + (inside ? 0.3 * std::sin(5.0 * x) : 0), 0);
    }
  for (Index y = 0; y < cells; ++y)
    for (Index x = 0; x < cells; ++x) {
      const Index a = x + y * (cells + 1), d = a + cells + 1;
      patch.triangles.push_back({a, a + 1, d + 1});
      patch.triangles.push_back({a, d + 1, d});
    }
  return patch;
}

TEST_CASE("threads: regions and a surface of several blocks have the same bytes on one thread and on many") {
  const Patch large = sheet(180);
  CHECK(is_same(convert_on(1, large), convert_on(0, large)));
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Patch patch = random_domain(seed).patch;
    CHECK(is_same(convert_on(1, patch), convert_on(0, patch)));
  }
}

TEST_CASE(
    "threads: surfaces converted together become what each becomes alone, and a bad one does not harm the others") {
  std::vector<Patch> patches;
  for (std::uint64_t seed = 0; seed < 6; ++seed) patches.push_back(random_domain(seed).patch);
  patches[2].points[0].x() = std::nan("");
  std::vector<const Patch*> all;
  for (const Patch& patch : patches) all.push_back(&patch);
  const std::vector<Outcome> outcomes = convert_all(all);
  REQUIRE(outcomes.size() == patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    CAPTURE(i);
    CHECK(outcomes[i].conversion.has_value() == (i != 2));
    CHECK(outcomes[i].error.has_value() == (i == 2));
    if (outcomes[i].conversion) CHECK(is_same(outcomes[i].conversion->mesh, convert_on(1, patches[i])));
  }
}

}  // namespace
