// SPDX-License-Identifier: GPL-2.0-or-later
// The quad in a sharp corner becomes a kite where it had a straight corner.
#include "cleanup/open_tip.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

#include "kernel/fixture.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

constexpr Index kRungs = 6;

/// A row of quads from a tip of so many degrees on: one side has a node more than the other. Node 0 is the tip, odd
/// nodes are on the longer side.
Mesh tip(double degrees, bool mirrored) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vec2 along(std::cos(angle), std::sin(angle));
  std::vector<Vec2> points{{0, 0}, {1, 0}};
  Polygons faces;
  for (Index i = 1; i < kRungs; ++i) {
    points.push_back(double(i) * along);
    points.push_back({i + 1.0, 0});
    const Index b = 2 * i, a = b + 1;
    faces.push_back({b - 2, b - 1, a, b});
    if (i == 1) faces.back() = {0, 1, 3, 2};
  }
  if (mirrored) {
    for (Vec2& p : points) p.y() = -p.y();
    for (auto& face : faces) std::reverse(face.begin(), face.end());
  }
  return drawn(points, faces);
}

}  // namespace

TEST_CASE("tips: a quad with a straight corner in a sharp one becomes a kite, whichever side has the node more") {
  for (double degrees : {4, 6, 12, 20})
    for (bool mirrored : {false, true}) {
      CAPTURE(degrees);
      CAPTURE(mirrored);
      Mesh mesh = tip(degrees, mirrored);
      const Edges boundary = boundary_of(mesh);
      REQUIRE(topology::smallest_sine(mesh) < 1e-9);
      CHECK(cleanup::open_tips(mesh, {}) == 1);
      CHECK(topology::smallest_sine(mesh) > 0.8 * std::sin(degrees * std::numbers::pi / 180));
      CHECK(mesh.valence(0) == 2);
      CHECK(defect(mesh) == "");
      CHECK(boundary_of(mesh) == boundary);
      CHECK(count_quads(mesh) == count(mesh).faces);
    }
}

TEST_CASE("tips: a row of a single quad, or one that meets itself, has no tip to open") {
  const Mesh square = drawn({{0, 0}, {1, 0}, {2, 0}, {1, 1}}, {{0, 1, 2, 3}});
  CHECK(cleanup::find_tip_row(square, 0, 1, true, 8).rungs.empty());
  CHECK(cleanup::find_tip_row(square, 0, 1, false, 8).rungs.empty());
  const Mesh row = tip(10, false);
  CHECK(cleanup::find_tip_row(row, 0, 1, true, 8).rungs.size() == kRungs);
  CHECK(cleanup::find_tip_row(row, 0, 1, true, 3).rungs.size() == 4);
}
