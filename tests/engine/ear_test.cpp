// SPDX-License-Identifier: GPL-2.0-or-later
// The triangle that an odd boundary leaves goes into a sharp corner.
#include "engine/ear.hpp"

#include <doctest/doctest.h>

#include "qmorph/convert.hpp"
#include "support/invariants.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// A wedge that runs out in a tip at the left, of `columns` quads cut in two and an ear.
Patch wedge(Index columns) {
  Patch patch;
  patch.points.emplace_back(0, 0, 0);
  for (Index i = 0; i <= columns; ++i)
    for (int side : {-1, 1}) patch.points.emplace_back(1 + i, side * (0.25 + 0.1 * i), 0);
  patch.triangles.push_back({0, 1, 2});
  for (Index i = 0; i < columns; ++i) {
    const Index low = 1 + 2 * i;
    patch.triangles.push_back({low, low + 2, low + 3});
    patch.triangles.push_back({low, low + 3, low + 1});
  }
  return patch;
}

Region region_of(const Patch& patch) {
  std::vector<Vec2> points;
  for (const auto& p : patch.points) points.emplace_back(p.x(), p.y());
  return cut_into_regions(patch, points)[0];
}

}  // namespace

TEST_CASE("ear: the sharpest corner with a triangle of its own is found; right angles do not count") {
  const Region region = region_of(wedge(3));
  const auto ear = sharpest_ear(region);
  REQUIRE(ear.has_value());
  CHECK(region.node[ear->tip] == 0);
  CHECK(region.node[ear->before] == 2);
  CHECK(region.node[ear->after] == 1);
  Patch square;
  square.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  CHECK_FALSE(sharpest_ear(region_of(square)).has_value());
}

TEST_CASE("ear: cut off and put back, the region is what it was") {
  const Region region = region_of(wedge(2));
  const Ear ear = *sharpest_ear(region);
  const Region rest = cut_off(region, ear);
  CHECK(rest.triangles.size() == region.triangles.size() - 1);
  CHECK(rest.boundary_sides == region.boundary_sides - 1);
  kernel::Mesh mesh(rest.points, rest.triangles, rest.open);
  CHECK_FALSE(mesh.is_live_vertex(ear.tip));
  put_back(mesh, ear);
  CHECK(find_defects(mesh).empty());
  CHECK(mesh.valence(ear.tip) == 2);
  const Index f = mesh.face(mesh.find(ear.tip, ear.after));
  CHECK(mesh.is_triangle(f));
  CHECK(mesh.face(mesh.find(ear.after, ear.before)) == f);
  CHECK(mesh.is_boundary_edge(mesh.find(ear.before, ear.tip)));
  CHECK_FALSE(mesh.is_boundary_edge(mesh.find(ear.after, ear.before)));
}

TEST_CASE("ear: the one triangle of a wedge is its tip") {
  const Patch patch = wedge(4);
  const QuadMesh mesh = convert(patch, Options{}).mesh;
  CHECK(broken_invariants(patch, mesh).empty());
  REQUIRE(mesh.triangles.size() == 1);
  bool at_tip = false;
  for (Index v : mesh.triangles[0]) at_tip = at_tip || mesh.source[v] == 0;
  CHECK(at_tip);
}
