// SPDX-License-Identifier: GPL-2.0-or-later
// Small regions without room for nodes inside.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bands/lay_chords.hpp"
#include "bands/least_of.hpp"
#include "engine/regions.hpp"
#include "kernel/fixture.hpp"
#include "qmorph/convert.hpp"
#include "support/invariants.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// Triangles between the nodes of a convex polygon: ears are cut off in a random order.
Patch cut_at_random(const std::vector<Vec2>& polygon, Rng& rng) {
  Patch patch;
  for (const Vec2& p : polygon) patch.points.emplace_back(p.x(), p.y(), 0);
  std::vector<Index> left;
  for (Index i = 0; i < polygon.size(); ++i) left.push_back(i);
  while (left.size() > 3) {
    const auto i = std::size_t(rng.range(0, int(left.size()) - 1));
    patch.triangles.push_back({left[(i + left.size() - 1) % left.size()], left[i], left[(i + 1) % left.size()]});
    left.erase(left.begin() + std::ptrdiff_t(i));
  }
  patch.triangles.push_back({left[0], left[1], left[2]});
  return patch;
}

/// Between two arcs that meet in two tips.
std::vector<Vec2> lens(int below, int above, double width, Rng& rng) {
  std::vector<Vec2> polygon;
  const auto arc = [&](int edges, double side) {
    for (int i = 0; i < edges; ++i) {
      const double x = (i + (i > 0 ? rng.between(-0.2, 0.2) : 0)) / edges;
      polygon.emplace_back(side < 0 ? x : 1 - x, side * width * x * (1 - x));
    }
  };
  arc(below, -1);
  arc(above, 1);
  return polygon;
}

/// Two straight sides with an angle between them, nodes facing each other, the first and last ones joined to a tip and
/// to each other.
std::vector<Vec2> wedge(int edges, double angle) {
  std::vector<Vec2> polygon{{0, 0}};
  for (int i = 1; i <= edges; ++i) polygon.emplace_back(i, 0);
  for (int i = edges; i >= 1; --i) polygon.push_back(rotated({double(i), 0}, angle));
  return polygon;
}

Region region_of(const Patch& patch) {
  std::vector<Vec2> points;
  for (const auto& p : patch.points) points.push_back(p.head<2>());
  return cut_into_regions(patch, points).at(0);
}

double price(const std::vector<Vec2>& q) {
  double least = 1;
  for (std::size_t i = 0; i < 4; ++i) least = std::min(least, corner_sine(q[i], q[(i + 1) % 4], q[(i + 3) % 4]));
  return least > 1e-6 ? 1 / least : std::numeric_limits<double>::infinity();
}

/// Of all ways, without remembering any: the least sum of 1 / sine, and 1 for a triangle.
double cheapest(const std::vector<Vec2>& polygon) {
  const std::size_t n = polygon.size();
  if (n == 2) return 0;
  const auto part = [&](std::size_t from, std::size_t to) {
    return std::vector<Vec2>(polygon.begin() + std::ptrdiff_t(from), polygon.begin() + std::ptrdiff_t(to) + 1);
  };
  const auto triangles = [](std::size_t size) { return size % 2; };
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k + 1 < n; ++k) {
    if (n % 2 == 1 && triangles(k + 1) == 0 && triangles(n - k) == 0)
      best = std::min(best, 1 + cheapest(part(0, k)) + cheapest(part(k, n - 1)));
    for (std::size_t l = k + 1; l + 1 < n; ++l)
      if (triangles(k + 1) + triangles(l - k + 1) + triangles(n - l) == n % 2)
        best = std::min(best, price({polygon[0], polygon[k], polygon[l], polygon[n - 1]}) + cheapest(part(0, k)) +
                                  cheapest(part(k, l)) + cheapest(part(l, n - 1)));
  }
  return best;
}

double price_of(const kernel::Mesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f)) sum += mesh.is_quad(f) ? 1 / mesh.smallest_sine(f) : 1;
  return sum;
}

}  // namespace

TEST_CASE("chords: a lens becomes quads between its own nodes, and one triangle if it is odd") {
  Rng rng(3);
  for (int trial = 0; trial < 100; ++trial) {
    CAPTURE(trial);
    const int below = rng.range(3, 16), above = std::max(3, below + rng.range(-2, 2));
    const Region region = region_of(cut_at_random(lens(below, above, rng.between(0.2, 0.6), rng), rng));
    const auto mesh = bands::lay_chords(region);
    REQUIRE(mesh);
    CHECK(kernel::find_defects(*mesh, false) == std::vector<std::string>());
    CHECK(boundary_of(*mesh) == boundary_of(kernel::Mesh(region.points, region.triangles, region.open)));
    CHECK(count(*mesh).faces - count_quads(*mesh) == region.boundary_sides % 2);
  }
}

TEST_CASE("chords: no other way is cheaper") {
  Rng rng(4);
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const int below = rng.range(2, 5);
    const std::vector<Vec2> polygon = lens(below, below + rng.range(0, 1), rng.between(0.4, 1.2), rng);
    if (polygon.size() < 5) continue;
    const auto mesh = bands::lay_chords(region_of(cut_at_random(polygon, rng)));
    const double least = cheapest(polygon);
    REQUIRE(mesh.has_value() == std::isfinite(least));
    if (mesh) CHECK(price_of(*mesh) == doctest::Approx(least));
  }
}

TEST_CASE("chords: the triangle of an odd wedge lies in its tip, and all else is a ladder") {
  for (const double degrees : {5.0, 10.0, 15.0}) {
    CAPTURE(degrees);
    Rng rng(5);
    const Patch patch = cut_at_random(wedge(12, degrees * std::numbers::pi / 180), rng);
    const Conversion conversion = convert(patch);
    CHECK(broken_invariants(patch, conversion.mesh) == std::vector<std::string>());
    CHECK(conversion.mesh.quads.size() == 11);
    CHECK(conversion.mesh.triangles.size() == 1);
    CHECK(least_of(conversion.mesh) > 0.98);
  }
}

TEST_CASE("chords: what has room for nodes inside, a hole or a fixed node is left alone") {
  Patch patch;
  for (int k = 0; k < 12; ++k)
    patch.points.emplace_back(std::cos(k * std::numbers::pi / 6), std::sin(k * std::numbers::pi / 6), 0);
  patch.points.emplace_back(0, 0, 0);
  for (Index k = 0; k < 12; ++k) patch.triangles.push_back({k, (k + 1) % 12, 12});
  CHECK(bands::lay_chords(region_of(patch)));
  patch.fixed = {12};
  CHECK_FALSE(bands::lay_chords(region_of(patch)));
}
