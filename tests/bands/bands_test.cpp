// SPDX-License-Identifier: GPL-2.0-or-later
// Thin rings and strips become rows of quads.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "bands/lay_rows.hpp"
#include "engine/regions.hpp"
#include "kernel/fixture.hpp"
#include "qmorph/convert.hpp"
#include "support/invariants.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// Nodes of the two sides, and triangles between them: always the next one of the side that is behind.
Patch zipped(const std::vector<Vec2>& lower, const std::vector<Vec2>& upper, bool closed) {
  Patch patch;
  for (const auto* side : {&lower, &upper})
    for (const Vec2& p : *side) patch.points.emplace_back(p.x(), p.y(), 0);
  const std::size_t n = lower.size(), m = upper.size(), edges = n - !closed, others = m - !closed;
  for (std::size_t i = 0, j = 0; i < edges || j < others;) {
    const Index a = Index(i % n), b = Index(n + j % m);
    if (j == others || (i < edges && (i + 1) * others <= (j + 1) * edges))
      patch.triangles.push_back({a, Index(++i % n), b});
    else
      patch.triangles.push_back({a, Index(n + ++j % m), b});
  }
  return patch;
}

/// `inner` and `outer` nodes, `gap` inner edges apart. Each side starts at an angle of its own.
Patch ring(int inner, int outer, double gap, double turn) {
  const auto circle = [](int count, double radius, double from) {
    std::vector<Vec2> points;
    for (int k = 0; k < count; ++k) points.push_back(rotated({radius, 0}, from + 2 * std::numbers::pi * k / count));
    return points;
  };
  Patch patch = zipped(circle(inner, 1, 0), circle(outer, 1 + gap * 2 * std::numbers::pi / inner, turn), true);
  for (auto& t : patch.triangles) std::swap(t[1], t[2]);  // counter-clockwise, the inner circle being on the right
  return patch;
}

Patch strip(int lower, int upper, double gap) {
  const auto line = [](int edges, double y) {
    std::vector<Vec2> points;
    for (int k = 0; k <= edges; ++k) points.emplace_back(double(k) / edges, y);
    return points;
  };
  return zipped(line(lower, 0), line(upper, gap / lower), false);
}

Region region_of(const Patch& patch) {
  std::vector<Vec2> points;
  for (const auto& p : patch.points) points.push_back(p.head<2>());
  return cut_into_regions(patch, points).at(0);
}

struct Figures {
  double least = 1, mean = 0;
  std::size_t quads = 0;
};

Figures figures(const QuadMesh& mesh) {
  Figures result;
  result.quads = mesh.quads.size();
  for (const auto& q : mesh.quads) {
    double sine = 1;
    for (int i = 0; i < 4; ++i)
      sine = std::min(sine, corner_sine(mesh.points[q[i]].head<2>(), mesh.points[q[(i + 1) % 4]].head<2>(),
                                        mesh.points[q[(i + 3) % 4]].head<2>()));
    result.least = std::min(result.least, sine);
    result.mean += sine / double(mesh.quads.size());
  }
  return result;
}

Figures converted(const Patch& patch) {
  const Conversion conversion = convert(patch);
  CHECK(broken_invariants(patch, conversion.mesh) == std::vector<std::string>());
  CHECK(conversion.mesh.triangles.size() <= 1);  // the invariants say when there is one
  return figures(conversion.mesh);
}

/// Smallest scaled Jacobians and means of 40 rings and strips, on average, whose sides have `more(n, rng)` nodes more
/// on one side than on the other. None has a poor quad.
Figures average_of_bands(unsigned seed, const std::function<int(int, Rng&)>& more) {
  Rng rng(seed);
  constexpr int kTrials = 20;
  Figures average{0, 0, 0};
  for (int trial = 0; trial < kTrials; ++trial) {
    CAPTURE(trial);
    const int n = rng.range(20, 60), m = n + more(n, rng);
    const double gap = rng.between(0.8, 1.8);
    for (const Patch& patch : {ring(n, m, gap, rng.between(0, 6.0 / m)), strip(n, m, gap)}) {
      const Figures one = converted(patch);
      CHECK(one.least > 0.4);
      average.least += one.least / (2 * kTrials), average.mean += one.mean / (2 * kTrials);
    }
  }
  return average;
}

}  // namespace

TEST_CASE("bands: whatever the numbers of nodes, rows are laid, one triangle if they are odd; the boundary stays") {
  Rng rng(1);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const int n = rng.range(12, 90);
    const int m = int(n * rng.between(1, 2));
    const double gap = rng.between(0.3, 3);
    const bool is_ring = rng.chance(0.5), more_outside = rng.chance(0.5);
    const Patch patch = is_ring ? ring(more_outside ? n : m, more_outside ? m : n, gap, rng.between(0, 6.0 / m))
                                : strip(more_outside ? n : m, more_outside ? m : n, gap);
    const Region region = region_of(patch);
    const auto band = bands::find_band(region);
    REQUIRE(band);
    for (const bands::RowCosts& costs : {bands::kBetterTurns, bands::kFewerTurns}) {
      const auto mesh = bands::lay_rows(*band, region.points, costs);
      if (!mesh) continue;
      CHECK(kernel::find_defects(*mesh, false) == std::vector<std::string>());
      CHECK(count_quads(*mesh) + std::size_t((n + m) % 2) == count(*mesh).faces);
      CHECK(boundary_of(*mesh) == boundary_of(kernel::Mesh(region.points, region.triangles, region.open)));
    }
  }
}

TEST_CASE("bands: a ring with equally many nodes on both sides becomes one row, wherever the nodes are") {
  for (double turn : {0.0, 0.01, 0.05}) {
    const Figures result = converted(ring(60, 60, 0.8, turn));
    CHECK(result.quads == 60);
    CHECK(result.least > 0.6);
  }
}

TEST_CASE("bands: rings and strips with different numbers of nodes have no poor quad") {
  const Figures average = average_of_bands(2, [](int n, Rng& rng) { return 2 * rng.range(1, n / 8); });
  // The front alone comes to 0.68 and 0.904.
  CHECK(average.least > 0.70);
  CHECK(average.mean > 0.908);
}

TEST_CASE("bands: a thin strip whose ends have a node in their middles is two rows, not one of leaning quads") {
  constexpr double kThick = 0.08;
  for (int edges : {2, 3, 6, 10})
    for (double lean : {0.0, kThick}) {
      CAPTURE(edges);
      CAPTURE(lean);
      std::vector<Vec2> lower, upper{{lean / 2 - 0.1 * kThick, kThick / 2}};
      for (int k = 0; k <= edges; ++k) lower.emplace_back(k, 0), upper.emplace_back(k + lean, kThick);
      upper.emplace_back(edges + lean / 2 + 0.1 * kThick, kThick / 2);
      const Figures result = converted(zipped(lower, upper, false));
      CHECK(result.quads == std::size_t(2 * edges));
      CHECK(result.least > 0.5);
    }
}

TEST_CASE("bands: rings and strips with odd boundaries have no poor quad besides their triangle") {
  const Figures average = average_of_bands(3, [](int n, Rng& rng) { return 1 + 2 * rng.range(0, n / 8); });
  // The front alone comes to 0.703 and 0.916.
  CHECK(average.least > 0.74);
  CHECK(average.mean > 0.92);
}

TEST_CASE("bands: an odd ring of one row has a triangle and nothing else that is not a row") {
  const Figures result = converted(ring(30, 31, 1, 0));
  CHECK(result.quads == 30);
  CHECK(result.least > 0.7);
}

TEST_CASE("bands: a region that is thick, or has five corners or a fixed node inside, is no band") {
  const auto finds = [](const Patch& patch) {
    const Region region = region_of(patch);
    const auto band = bands::find_band(region);
    return band && bands::lay_rows(*band, region.points, bands::kBetterTurns);
  };
  CHECK(finds(ring(40, 44, 2, 0)));
  CHECK_FALSE(finds(ring(40, 44, 6, 0)));
  CHECK(finds(strip(20, 22, 1)));
  Patch corner = strip(20, 22, 1);
  corner.points[10].y() -= 0.04;
  CHECK_FALSE(finds(corner));
}
