// SPDX-License-Identifier: GPL-2.0-or-later The laws of the engine on random curved surfaces. Re-run one seed with:
// qmorph_campaign 2000000000+SEED 2000000000+SEED
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "qmorph/convert.hpp"
#include "support/invariants.hpp"
#include "support/pool.hpp"
#include "support/seeds.hpp"
#include "support/surfaces.hpp"

using namespace qmorph;
using namespace qmorph::test;

namespace {

Options options_for(std::uint64_t seed) {
  Options options;
  if (seed % 10 != 0) options.retry_triangles = 0;  // tries with other constants take most of the time
  return options;
}

}  // namespace

TEST_CASE("random surfaces: regions of a few triangles get more tries if the first is doubtful or not valid") {
  for (const std::uint64_t seed : {4993u, 5596u}) {  // few are so small and so bent
    const Domain domain = random_surface(seed);
    CAPTURE(domain.kind);
    CHECK(broken_invariants(domain.patch, convert(domain.patch).mesh).empty());
  }
}

// One quad lay over an edge at which its surface turns by 78 degrees, between quads that stay, valid by the triangles
// on this side of a constraint, and turned over by the nearest of all.
TEST_CASE("random surfaces: no corner leans back over an edge that turns sharply between quads that stay") {
  const Domain domain = random_surface(1716);
  CHECK(broken_invariants(domain.patch, convert(domain.patch).mesh).empty());
}

TEST_CASE("1000 random surfaces convert without breaking an invariant") {
  for (std::uint64_t seed = 0; seed < seeds(1000); ++seed) {
    const Domain domain = random_surface(seed);
    std::string problem;
    try {
      const auto broken = broken_invariants(domain.patch, convert(domain.patch, options_for(seed)).mesh);
      if (!broken.empty()) problem = broken.front();
    } catch (const std::exception& e) {
      problem = e.what();
    }
    if (problem.empty()) continue;
    CAPTURE(seed);
    CAPTURE(domain.kind);
    FAIL_CHECK(problem);
  }
}

TEST_CASE("1000 random domains rolled onto cylinders and cones come out as well as in the plane") {
  Pool flat, bent;
  std::size_t refused = 0;  // slivers between three nodes of a line turn over where the line is bent
  for (std::uint64_t seed = 0; seed < seeds(1000); ++seed) {
    const Patch patch = random_domain(seed).patch;
    Rng rng(seed);
    Options options;
    options.retry_triangles = 150;  // tries with other constants are for small ones; for larger ones they take long
    try {
      const QuadMesh plane = convert(patch, options).mesh;
      const QuadMesh curved = convert(rolled(patch, seed % 2 ? rng.between(0.3, 0.9) : 0, rng), options).mesh;
      flat.add(plane);
      bent.add(curved);
      CHECK(curved.triangles.size() == plane.triangles.size());
    } catch (const SurfaceError& error) {
      CHECK(error.place());
      ++refused;
    }
  }
  CHECK(100 * refused <= seeds(1000) + 99);
  // A single domain says little: a further margin for when there are few.
  const double few = std::max(0.0, std::sqrt(1000 / double(seeds(1000))) - 1);
  CHECK(bent.mean() == doctest::Approx(flat.mean()).epsilon(0.02));
  CHECK(bent.quads == doctest::Approx(flat.quads).epsilon(0.02 + 0.002 * few));
  CHECK(bent.irregular_share() <= flat.irregular_share() * 1.02 + 0.004 * few);
}
