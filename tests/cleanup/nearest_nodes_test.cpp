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

/// From the node that was next to where the walk began.
std::vector<Index> way_back(const NearestNodes& nearest, Index start) {
  std::vector<Index> way;
  nearest.way_back(way, [&](Index v) { return v == start; });
  return way;
}

}  // namespace

TEST_CASE("nearest nodes: each node of a grid comes once, and none before one that is nearer") {
  const Mesh mesh = quad_grid(8, 8);
  NearestNodes nearest(mesh);
  for (Index start : {Index(40), Index(10)}) {
    nearest.start(start);
    CHECK(nearest.next(kAll) == start);
    std::vector<bool> seen(mesh.vertex_slots(), false);
    std::size_t far = 0;
    int found = 1;
    for (Index v; (v = nearest.next(kAll)) != kNone; ++found) {
      CHECK_FALSE(seen[v]);
      seen[v] = true;
      const std::vector<Index> way = way_back(nearest, start);
      CHECK(way.front() == v);
      CHECK(way.size() >= far);
      far = way.size();
      for (std::size_t i = 0; i + 1 < way.size(); ++i) CHECK(mesh.find(way[i], way[i + 1]) != kNone);
      CHECK(nearest.edges() == (mesh.is_free(v) ? int(mesh.valence(v)) : 0));
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
