// SPDX-License-Identifier: GPL-2.0-or-later
// A walk to nodes, nearest first.
#include "cleanup/nearest_nodes.hpp"

#include <doctest/doctest.h>

#include "kernel/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using cleanup::NearestNodes;

constexpr std::size_t kAll = 1000;

/// Edges on the way back to where the walk began.
int steps_to(const NearestNodes& nearest, Index v) {
  int steps = 0;
  for (; nearest.before(v) != kNone; v = nearest.before(v)) ++steps;
  return steps;
}

}  // namespace

TEST_CASE("nearest nodes: each node of a grid comes once, and none before one that is nearer") {
  const Mesh mesh = quad_grid(8, 8);
  NearestNodes nearest(mesh);
  for (Index start : {Index(40), Index(10)}) {
    nearest.start(start);
    CHECK(nearest.next(kAll) == start);
    std::vector<bool> seen(mesh.vertex_slots(), false);
    int far = 0, found = 1;
    for (Index v; (v = nearest.next(kAll)) != kNone; ++found) {
      CHECK_FALSE(seen[v]);
      seen[v] = true;
      CHECK(steps_to(nearest, v) >= far);
      far = steps_to(nearest, v);
      CHECK(mesh.find(v, nearest.before(v)) != kNone);
    }
    CHECK(found == 81 - 4);  // the corners have no free neighbour
  }
}

TEST_CASE("nearest nodes: paths lead through free nodes") {
  Mesh mesh = quad_grid(8, 8);
  for (Index y = 0; y < 8; ++y) mesh.set_fixed(9 * y + 5);
  NearestNodes nearest(mesh);
  nearest.start(39);
  for (Index v; (v = nearest.next(kAll)) != kNone;) CHECK(v % 9 <= 5);
}

TEST_CASE("nearest nodes: it looks at no more than it is asked to") {
  const Mesh mesh = quad_grid(8, 8);
  NearestNodes nearest(mesh);
  nearest.start(40);
  int found = 0;
  while (nearest.next(10) != kNone) ++found;
  CHECK(found == 10);
}
