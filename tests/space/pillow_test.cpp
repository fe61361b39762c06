// SPDX-License-Identifier: GPL-2.0-or-later
// A row of quads around given ones.
#include "space/pillow.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "qmorph/check.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"
#include "space/surfaces.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// Those with a node of the boundary to themselves.
std::vector<Index> quads_in_corners(const space::Result& result) {
  const QuadMesh& mesh = result.mesh();
  const Index triangles = Index(mesh.triangles.size());
  std::vector<Index> quads;
  for (Index q = 0; q < mesh.quads.size(); ++q)
    for (Index side = 4 * (triangles + q); side < 4 * (triangles + q) + 4; ++side)
      if (result.sides().opposite(side) == kNone && result.sides().opposite(result.sides().previous(side)) == kNone)
        quads.push_back(q);
  return quads;
}

/// A hexagon of six triangles, and the three quads that it is.
struct Hexagon {
  Patch patch;
  QuadMesh mesh;

  Hexagon() {
    for (int i = 0; i < 6; ++i) {
      const double angle = i * std::numbers::pi / 3;
      patch.points.emplace_back(std::cos(angle), std::sin(angle), 0.5);
      patch.triangles.push_back({Index(i), Index((i + 1) % 6), 6});
    }
    patch.points.emplace_back(0, 0, 0.5);
    mesh = {patch.points, {0, 1, 2, 3, 4, 5, 6}, {}, {{6, 0, 1, 2}, {6, 2, 3, 4}, {6, 4, 5, 0}}};
  }
};

TEST_CASE("pillow: around all quads of a hexagon lies a ring, and each corner of it has two") {
  const Hexagon hexagon;
  const space::Result result(hexagon.patch, hexagon.mesh);
  CHECK(quads_in_corners(result).size() == 3);
  const QuadMesh mesh = space::pillow(hexagon.patch, result, std::vector<Index>{0, 1, 2});
  CHECK(mesh.quads.size() == 9);
  CHECK(mesh.points.size() == 13);  // the middle stays, and there are six more
  CHECK(!find_defect(hexagon.patch, mesh));
  CHECK(quads_in_corners(space::Result(hexagon.patch, mesh)).empty());
  for (int i = 0; i < 6; ++i) CHECK(mesh.points[i] == hexagon.patch.points[i]);
}

TEST_CASE("pillow: around one quad four are put, and no other quad changes") {
  const Hexagon hexagon;
  const space::Result result(hexagon.patch, hexagon.mesh);
  const QuadMesh mesh = space::pillow(hexagon.patch, result, std::vector<Index>{1});
  CHECK(mesh.quads.size() == 7);
  CHECK(!find_defect(hexagon.patch, mesh));
  CHECK(mesh.quads[0] == hexagon.mesh.quads[0]);
  CHECK(mesh.quads[2] == hexagon.mesh.quads[2]);
  CHECK(quads_in_corners(space::Result(hexagon.patch, mesh)).size() == 2);
}

TEST_CASE("pillow: on a curved surface the new nodes lie on its triangles") {
  const Patch patch = cylinder({.across = 10, .along = 12, .jitter = 0.2}, 1.0 / 3);
  const QuadMesh before = convert(patch).mesh;
  const space::Result result(patch, before);
  const std::vector<Index> corners = quads_in_corners(result);
  REQUIRE(corners.size() >= 4);
  const QuadMesh mesh = space::pillow(patch, result, corners);
  CHECK(mesh.quads.size() == before.quads.size() + 4 * corners.size());
  CHECK(!find_defect(patch, mesh));
  const space::Result after(patch, mesh);
  for (Index v = Index(before.points.size()); v < mesh.points.size(); ++v) CHECK(after.foot(v).distance2 < 1e-20);
}

}  // namespace
