// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/tips.hpp"

#include <doctest/doctest.h>

using qmorph::Patch;

namespace {

/// Two quads of the row behind a tip, and the quad at the tip, which is straight where the three meet (node 0).
Patch straight_tip() {
  Patch patch;
  patch.points = {{1, 0, 0}, {0, 0, 0}, {1, -1, 0}, {1, 1, 0}, {3, 0, 0}, {3, -1, 0}, {3, 1, 0}};
  patch.quads = {{0, 2, 5, 4}, {0, 4, 6, 3}, {1, 2, 0, 3}};
  return patch;
}

}  // namespace

TEST_CASE("layers: a tip that is straight where the next row begins is widened along the edge to that row") {
  const Patch before = straight_tip();
  Patch after = before;
  qmorph::layers::widen_tips(after, 0, 1);
  CHECK(after.points[0].x() > before.points[0].x() + 0.2);
  CHECK(after.points[0].tail<2>() == before.points[0].tail<2>());
  for (std::size_t v = 1; v < before.points.size(); ++v) CHECK(after.points[v] == before.points[v]);
}

TEST_CASE("layers: a tip is left as it is between quads that the input had") {
  const Patch before = straight_tip();
  for (const std::size_t given : {1u, 2u}) {
    Patch after = before;
    qmorph::layers::widen_tips(after, given, 1);
    CHECK(after.points == before.points);
  }
}
