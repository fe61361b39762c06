// SPDX-License-Identifier: GPL-2.0-or-later
// Nets of gaps: regions that are narrow everywhere, and meet in junctions.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "bands/gap_net.hpp"
#include "bands/lay_gaps.hpp"
#include "bands/least_of.hpp"
#include "engine/regions.hpp"
#include "geometry/predicates.hpp"
#include "kernel/fixture.hpp"
#include "qmorph/convert.hpp"
#include "support/invariants.hpp"
#include "support/rng.hpp"
#include "support/sketch.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

Patch patch_of(const Sketch& sketch) {
  Rng rng(1);
  const Draft draft = sketch.build(rng).value();
  Patch patch;
  for (const auto& p : draft.points) patch.points.emplace_back(p.x(), p.y(), 0);
  patch.triangles = draft.triangles;
  return patch;
}

/// Mortar between bricks, each row shifted by a share of a brick against the one below.
Patch mortar(double width, double size, double shift) {
  constexpr int kRows = 3, kColumns = 3;
  constexpr double kLong = 0.5, kHigh = 0.25;
  Sketch sketch;
  sketch.size.smallest = sketch.size.largest = size;
  sketch.filling.pattern = Filling::Pattern::nothing;
  const auto rectangle = [&](double left, double below, double right, double above) {
    sketch.path({{left, below}, {right, below}, {right, above}, {left, above}}, SegmentKind::boundary, true);
  };
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double x = -0.9 + column * (kLong + width) + row * shift * kLong, y = -0.6 + row * (kHigh + width);
      rectangle(x, y, x + kLong, y + kHigh);
    }
  const double most = kColumns * (kLong + width) + (kRows - 1) * shift * kLong;
  rectangle(-0.9 - width, -0.6 - width, -0.9 + most, -0.6 + kRows * (kHigh + width));
  return patch_of(sketch);
}

std::vector<Vec2> flat(const Patch& patch) {
  std::vector<Vec2> points;
  for (const auto& p : patch.points) points.push_back(p.head<2>());
  return points;
}

}  // namespace

TEST_CASE("gaps: the mortar between bricks is a net of gaps with a junction wherever three of them meet") {
  const Patch patch = mortar(0.02, 0.08, 0.5);
  const Region region = cut_into_regions(patch, flat(patch)).at(0);
  const auto net = bands::find_gaps(region);
  REQUIRE(net);
  CHECK(net->junctions >= 9);
  std::size_t triangles = net->junctions;
  for (const bands::Gap& gap : net->gaps) {
    triangles += gap.lower.size() + gap.upper.size() - 2;
    triangles += gap.ends[1].junction == kNone;
  }
  CHECK(triangles == region.boundary_sides - 2 + 2 * 9);  // nine holes, no node inside
}

TEST_CASE("gaps: a net becomes quads, and a triangle if it is odd; the boundary stays") {
  Rng rng(7);
  int laid = 0;
  for (int trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    const Patch patch = mortar(rng.between(0.01, 0.05), rng.between(0.05, 0.12), rng.between(0.1, 0.5));
    for (const Region& region : cut_into_regions(patch, flat(patch))) {
      const auto mesh = bands::lay_gaps(region);
      if (!mesh) continue;
      ++laid;
      CHECK(kernel::find_defects(*mesh, false) == std::vector<std::string>());
      CHECK(boundary_of(*mesh) == boundary_of(kernel::Mesh(region.points, region.triangles, region.open)));
      CHECK(count(*mesh).faces - count_quads(*mesh) == region.boundary_sides % 2);
    }
  }
  CHECK(laid > 30);
}

TEST_CASE("conversion: mortar as wide as a fifth of an edge and more has no poor quad") {
  for (const double width : {0.015, 0.03, 0.05})
    for (const double shift : {0.3, 0.5}) {
      CAPTURE(width);
      CAPTURE(shift);
      const Patch patch = mortar(width, 0.07, shift);
      const Conversion conversion = convert(patch);
      CHECK(broken_invariants(patch, conversion.mesh) == std::vector<std::string>());
      CHECK(least_of(conversion.mesh) > 0.3);
    }
}

TEST_CASE("gaps: a region that is wide, or has a single gap, is no net") {
  Sketch sketch;
  sketch.size.smallest = sketch.size.largest = 0.1;
  sketch.path({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}, SegmentKind::boundary, true);
  const Patch wide = patch_of(sketch);
  CHECK_FALSE(bands::lay_gaps(cut_into_regions(wide, flat(wide)).at(0)));
  Sketch thin;
  thin.size.smallest = thin.size.largest = 0.1;
  thin.path({{-0.5, -0.02}, {0.5, -0.02}, {0.5, 0.02}, {-0.5, 0.02}}, SegmentKind::boundary, true);
  const Patch strip = patch_of(thin);
  CHECK_FALSE(bands::lay_gaps(cut_into_regions(strip, flat(strip)).at(0)));
}
