// SPDX-License-Identifier: GPL-2.0-or-later
// sort_unique() gives what a set would, however far apart the values are.
#include "kernel/sort_unique.hpp"

#include <doctest/doctest.h>

#include <random>
#include <set>

using qmorph::Index;

TEST_CASE("sort_unique: indices come out as from a set, near to each other or far apart") {
  std::mt19937 random(7);
  for (const Index span : {1u, 2u, 63u, 64u, 65u, 1000u, 100000u, 4000000000u})
    for (const std::size_t count : {0u, 1u, 2u, 7u, 64u, 500u}) {
      CAPTURE(span);
      CAPTURE(count);
      std::vector<Index> values;
      for (std::size_t i = 0; i < count; ++i)
        values.push_back(std::uniform_int_distribution<Index>(5, 4 + span)(random));
      const std::set<Index> expected(values.begin(), values.end());
      qmorph::sort_unique(values);
      CHECK(values == std::vector<Index>(expected.begin(), expected.end()));
    }
}

TEST_CASE("sort_unique: the least and the greatest index") {
  std::vector<Index> values{qmorph::kNone, 0, qmorph::kNone, 0};
  qmorph::sort_unique(values);
  CHECK(values == std::vector<Index>{0, qmorph::kNone});
}
