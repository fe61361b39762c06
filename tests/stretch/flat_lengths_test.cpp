// SPDX-License-Identifier: GPL-2.0-or-later
// Lengths that lie flat.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "chart/fixture.hpp"
#include "chart/flatten.hpp"
#include "stretch/flat_lengths.hpp"
#include "stretch/metric_field.hpp"

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;

namespace {

/// Of a metric that changes from place to place, so that it does not lie flat.
std::vector<double> lengths_of(const space::Background& surface) {
  std::vector<double> lengths;
  for (Index side = 0; side < 3 * surface.triangles(); ++side) {
    const Vector3d& a = surface.corner(side / 3, side % 3);
    const Vector3d& b = surface.corner(side / 3, (side + 1) % 3);
    const Vector3d middle = (a + b) / 2;
    const double ratio = 1 + 0.5 * std::sin(0.3 * middle.x()) * std::cos(0.2 * middle.y());
    lengths.push_back(std::hypot(ratio * (b - a).x(), (b - a).y() / ratio));
  }
  return lengths;
}

chart::Flattening flat(const space::Background& surface, const std::vector<double>& lengths) {
  return chart::flatten(surface, surface.points().size(), chart::kAllRounds, lengths);
}

}  // namespace

TEST_CASE("lengths of any metric on a disc lie flat once they are scaled") {
  const Patch patch = plate(30, 20);
  const space::Background surface(patch.points, patch.triangles);
  const std::vector<double> lengths = lengths_of(surface), scaled = stretch::flat_lengths(surface, lengths);
  REQUIRE(scaled.size() == lengths.size());
  CHECK(flat(surface, lengths).distortion > 1.02);
  const chart::Flattening chart = flat(surface, scaled);
  CHECK(chart.flipped == 0);
  CHECK(chart.distortion < 1.01);
}

TEST_CASE("a hole's boundary turns once the other way round") {
  Patch patch = plate(60, 8);
  for (Vector3d& p : patch.points) {
    const double angle = -p.x() * 2 * std::numbers::pi / 60, r = 8 + p.y();
    p = r * Vector3d(std::cos(angle), std::sin(angle), 0);
  }
  for (auto& t : patch.triangles)
    for (Index& v : t)
      if (v % 61 == 60) v -= 60;
  Patch ring;
  std::vector<Index> row(patch.points.size(), kNone);
  for (auto t : patch.triangles) {
    for (Index& v : t) {
      if (row[v] == kNone) row[v] = Index(ring.points.size()), ring.points.push_back(patch.points[v]);
      v = row[v];
    }
    ring.triangles.push_back(t);
  }
  const space::Background surface(ring.points, ring.triangles);
  const std::vector<double> scaled = stretch::flat_lengths(surface, lengths_of(surface));
  REQUIRE(!scaled.empty());
  const chart::Flattening chart = flat(surface, scaled);
  CHECK(chart.flipped == 0);
  CHECK(chart.distortion < 1.2);  // what goes once round need not close
}

TEST_CASE("a half sphere has flat lengths, a surface without boundary has none") {
  Patch cap = plate(24, 24);
  for (Vector3d& p : cap.points) {
    const Vec2 q(p.x() / 12 - 1, p.y() / 12 - 1);
    p = Vector3d(q.x(), q.y(), 1.2 - 0.5 * q.squaredNorm());
  }
  const space::Background surface(cap.points, cap.triangles);
  const std::vector<double> scaled = stretch::flat_lengths(surface, stretch::MetricField(surface).side_lengths());
  REQUIRE(!scaled.empty());
  CHECK(flat(surface, scaled).distortion < 1.01);

  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<space::Background::Triangle> closed{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const space::Background tetrahedron(points, closed);
  CHECK(stretch::flat_lengths(tetrahedron, std::vector<double>(12, 1.0)).empty());
}

TEST_CASE("the field of a plate whose triangles are all stretched alike is uniform, that of a ring is not") {
  Patch patch = plate(20, 20);
  for (Vector3d& p : patch.points) p.x() *= 9;
  const space::Background even(patch.points, patch.triangles);
  const auto metric = stretch::MetricField(even).uniform();
  REQUIRE(metric);
  CHECK(metric->ratio() == doctest::Approx(9).epsilon(0.3));
  for (Vector3d& p : patch.points) p = (100 + p.y()) * Vector3d(std::cos(p.x() / 100), std::sin(p.x() / 100), 0);
  const space::Background bent(patch.points, patch.triangles);
  CHECK(!stretch::MetricField(bent).uniform());
  CHECK(stretch::MetricField(bent).share_above(5) > 0.95);
}
