// SPDX-License-Identifier: GPL-2.0-or-later
// The generator: what it promises, and that it covers what it should.
#include "support/domains.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <set>

#include "support/invariants.hpp"
#include "support/seeds.hpp"

using qmorph::test::Domain;
using qmorph::test::random_domain;

TEST_CASE("random domains: 1000 seeds give valid patches") {
  for (std::uint64_t seed = 0; seed < qmorph::test::seeds(1000, 200); ++seed) {
    const Domain domain = random_domain(seed);
    const auto broken = qmorph::test::broken_inputs(domain.patch);
    if (broken.empty()) continue;
    CAPTURE(seed);
    CAPTURE(domain.kind);
    FAIL_CHECK(broken.front());
  }
}

TEST_CASE("random domains: a seed gives the same bytes each time") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    CAPTURE(seed);
    const Domain a = random_domain(seed), b = random_domain(seed);
    REQUIRE(a.patch.points.size() == b.patch.points.size());
    CHECK(std::memcmp(a.patch.points.data(), b.patch.points.data(), sizeof(Eigen::Vector3d) * a.patch.points.size()) ==
          0);
    CHECK(a.patch.triangles == b.patch.triangles);
    CHECK(a.patch.constraints == b.patch.constraints);
  }
}

TEST_CASE("random domains: every difficulty occurs") {
  std::set<std::string> words;
  std::size_t odd = 0, even = 0, several_regions = 0, single = 0, large = 0;
  const std::uint64_t domains = qmorph::test::seeds(1000, 300);
  for (std::uint64_t seed = 0; seed < domains; ++seed) {
    const Domain domain = random_domain(seed);
    std::string word;
    for (const char c : domain.kind + ' ') {
      if (c != ' ') {
        word += c;
      } else {
        words.insert(word);
        word.clear();
      }
    }
    const auto regions = qmorph::test::count_regions(domain.patch);
    odd += regions.odd > 0;
    even += regions.odd == 0;
    several_regions += regions.regions > 1;
    single += domain.patch.triangles.size() == 1;
    large += domain.patch.triangles.size() > 1000;
  }
  for (const char* word : {"polygon", "plate",  "wedge",    "spikes",    "ring",   "comb",     "channel", "graded",
                           "pinched", "ribbon", "embedded", "materials", "island", "coarse",   "lattice", "cloud",
                           "strip",   "fan",    "wheel",    "star",      "flips",  "jitter",   "walks",   "loop",
                           "borders", "points", "quads",    "upright",   "tilted", "clockwise"}) {
    CAPTURE(std::string(word));
    CHECK(words.contains(word));
  }
  CHECK(odd > domains / 5);
  CHECK(even > domains / 5);
  CHECK(several_regions > domains / 10);
  CHECK(single > 0);
  CHECK(large > domains / 20);
}
