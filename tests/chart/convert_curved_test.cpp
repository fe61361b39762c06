// SPDX-License-Identifier: GPL-2.0-or-later
// Curved surfaces of all kinds, from triangles to quads.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "chart/fixture.hpp"
#include "chart/widen_tips.hpp"
#include "chart/work_on_region.hpp"
#include "engine/budget.hpp"
#include "geometry/predicates.hpp"
#include "qmorph/check.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/error.hpp"
#include "qmorph/quality.hpp"
#include "space/corners.hpp"
#include "space/creases.hpp"
#include "space/surfaces.hpp"
#include "support/invariants.hpp"
#include "support/on_surface.hpp"

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;

namespace {

/// Share of nodes off the boundary that do not have four edges.
double irregular_share(const QuadMesh& mesh) {
  const Quality quality = measure(mesh);
  return quality.irregular_share();
}

void check(const Patch& patch, const QuadMesh& mesh) {
  for (const std::string& line : broken_invariants(patch, mesh)) FAIL_CHECK(line);
}

bool same_bytes(const QuadMesh& a, const QuadMesh& b) {
  return a.quads == b.quads && a.triangles == b.triangles && a.source == b.source &&
         a.points.size() == b.points.size() &&
         std::memcmp(a.points.data(), b.points.data(), sizeof(Vector3d) * a.points.size()) == 0;
}

Patch cone(int around, int rows, double slope) {  // tip first, no line
  Patch patch;
  patch.points.emplace_back(0, 0, 0);
  for (int r = 1; r <= rows; ++r)
    for (int k = 0; k < around * r; ++k) {
      const double angle = 2 * std::numbers::pi * k / (around * r);
      patch.points.emplace_back(r * std::cos(angle), r * std::sin(angle), -slope * r);
    }
  const auto node = [&](int r, int k) {
    return r == 0 ? Index(0) : Index(1 + around * (r * (r - 1)) / 2 + k % (around * r));
  };
  for (int r = 0; r < rows; ++r)
    for (int sector = 0; sector < around; ++sector)
      for (int k = 0; k <= r; ++k) {
        const int in = sector * r + k, out = sector * (r + 1) + k;
        patch.triangles.push_back({node(r, in), node(r + 1, out), node(r + 1, out + 1)});
        if (k < r) patch.triangles.push_back({node(r, in), node(r + 1, out + 1), node(r, in + 1)});
      }
  return patch;
}

}  // namespace

TEST_CASE("curved: closed surfaces without a line become quads alone") {
  Rng rng(20);
  struct Case {
    const char* name;
    Patch patch;
    int euler;
    double most_irregular;
  };
  for (const Case& c : {Case{"sphere", sphere(0.11, rng), 2, 0.04}, Case{"torus", torus(1, 0.35, 0.1, rng), 0, 0.05},
                        Case{"double torus", double_torus(0.11, rng), -2, 0.06}}) {
    CAPTURE(c.name);
    const QuadMesh mesh = convert(c.patch).mesh;
    CHECK(mesh.triangles.empty());
    CHECK(euler_characteristic(mesh.triangles, mesh.quads) == c.euler);
    CHECK(irregular_share(mesh) < c.most_irregular);
    CHECK(measure(mesh).scaled_jacobian_mean > 0.93);
    check(c.patch, mesh);
  }
}

TEST_CASE("curved: closed surfaces that touch at a node still do so as quads") {
  Rng rng(1);
  const Patch one = sphere(0.5, rng);
  const Index count = Index(one.points.size());
  const auto along = [&](double sign) {
    const auto less = [&](const Vector3d& a, const Vector3d& b) { return sign * a.x() < sign * b.x(); };
    return Index(std::max_element(one.points.begin(), one.points.end(), less) - one.points.begin());
  };
  const Index right = along(1), left = along(-1);
  Patch both = one;
  for (const Vector3d& p : one.points) both.points.push_back(p - one.points[left] + one.points[right]);
  for (const auto& t : one.triangles) {
    auto& copy = both.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) copy[i] = t[i] == left ? right : t[i] + count;
  }
  drop_unused(both);
  check(both, convert(both).mesh);
}

TEST_CASE("curved: the same bytes on one thread and two, and when it is called again") {
  Rng rng(21);
  for (const Patch& patch :
       {torus(1, 0.35, 0.15, rng), pierced(sphere(0.12, rng), {0, 0, 1}, 0.4), box({1, 1, 2}, 0.2, rng)}) {
    Options options;
    options.threads = 1;
    const QuadMesh first = convert(patch, options).mesh;
    options.threads = 2;
    CHECK(same_bytes(first, convert(patch, options).mesh));
    CHECK(same_bytes(first, convert(patch, options).mesh));
  }
}

TEST_CASE("curved: a cone keeps its tip, wide or pointed") {
  for (const double slope : {0.3, 1.0, 4.0}) {
    CAPTURE(slope);
    const Patch patch = cone(6, 9, slope);
    const QuadMesh mesh = convert(patch).mesh;
    check(patch, mesh);
    CHECK(mesh.triangles.empty());
    if (slope >= 1) CHECK(std::find(mesh.source.begin(), mesh.source.end(), Index(0)) != mesh.source.end());
    CHECK(measure(mesh).scaled_jacobian_min > (slope > 2 ? 0.2 : 0.5));
  }
}

TEST_CASE("curved: a pole where a line ends is a node like others") {
  // A sphere with a line from pole to pole, as periodic parametrisations have it.
  const int around = 24, rows = 12;
  Patch patch;
  patch.points.emplace_back(0, 0, 1);
  for (int r = 1; r < rows; ++r)
    for (int k = 0; k < around; ++k) {
      const double a = std::numbers::pi * r / rows, b = 2 * std::numbers::pi * k / around;
      patch.points.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    }
  patch.points.emplace_back(0, 0, -1);
  const Index south = Index(patch.points.size() - 1);
  const auto node = [&](int r, int k) { return Index(1 + (r - 1) * around + k % around); };
  for (int k = 0; k < around; ++k) {
    patch.triangles.push_back({0, node(1, k), node(1, k + 1)});
    patch.triangles.push_back({south, node(rows - 1, k + 1), node(rows - 1, k)});
    for (int r = 1; r < rows - 1; ++r) {
      patch.triangles.push_back({node(r, k), node(r + 1, k), node(r + 1, k + 1)});
      patch.triangles.push_back({node(r, k), node(r + 1, k + 1), node(r, k + 1)});
    }
  }
  patch.constraints.push_back({0, node(1, 0)});
  for (int r = 1; r < rows - 1; ++r) patch.constraints.push_back({node(r, 0), node(r + 1, 0)});
  patch.constraints.push_back({node(rows - 1, 0), south});
  const QuadMesh mesh = convert(patch).mesh;
  check(patch, mesh);
  CHECK(mesh.triangles.empty());
  CHECK(measure(mesh).scaled_jacobian_min > 0.3);
}

TEST_CASE("curved: sharp edges stay, whole or with a node in their middle") {
  Rng rng(22);
  const Patch patch = box({1, 1.5, 2}, 0.22, rng);
  const QuadMesh mesh = convert(patch).mesh;
  check(patch, mesh);
  CHECK(mesh.triangles.empty());
  const space::Background surface(patch.points, patch.triangles);
  std::set<std::pair<Index, Index>> edges;
  for (const auto& q : mesh.quads)
    for (int i = 0; i < 4; ++i) edges.insert(std::minmax(q[i], q[(i + 1) % 4]));
  std::vector<Index> row(patch.points.size(), kNone);
  for (Index v = 0; v < mesh.source.size(); ++v)
    if (mesh.source[v] != kNone) row[mesh.source[v]] = v;
  int whole = 0, split = 0;
  for (const auto& [a, b] : space::find_creases(surface, 0.7)) {
    REQUIRE(row[a] != kNone);
    REQUIRE(row[b] != kNone);
    CHECK(mesh.points[row[a]] == patch.points[a]);
    if (edges.contains(std::minmax(row[a], row[b]))) {
      ++whole;
      continue;
    }
    const Vector3d middle = 0.5 * (patch.points[a] + patch.points[b]);
    bool found = false;
    for (Index m = 0; m < mesh.points.size() && !found; ++m)
      found = (mesh.points[m] - middle).norm() < 1e-9 && edges.contains(std::minmax(row[a], m)) &&
              edges.contains(std::minmax(row[b], m));
    CHECK(found);
    ++split;
  }
  CHECK(whole > 0);
  CHECK(split <= 5);  // six faces
}

TEST_CASE("curved: a plate that is off its plane by a file's rounding is what it is in the plane") {
  Rng rng(23);
  const Patch plane = pierced(plate(24, 16), {12, 8, 0}, 4);
  for (const double noise : {1e-4, 1e-3, 0.02}) {
    CAPTURE(noise);
    Patch patch = plane;
    for (Vector3d& p : patch.points) p.z() += noise * rng.between(-1, 1);
    const QuadMesh mesh = convert(patch).mesh, flat = convert(plane).mesh;
    check(patch, mesh);
    CHECK(mesh.triangles.empty());
    CHECK(double(mesh.quads.size()) == doctest::Approx(double(flat.quads.size())).epsilon(0.08));
    CHECK(measure(mesh).scaled_jacobian_mean > measure(flat).scaled_jacobian_mean - 0.02);
  }
}

TEST_CASE("curved: a plate that is off its plane by about what a plane may be is the same to all who look at it") {
  Rng rng(29);
  const Patch plane = pierced(plate(8, 6), {4, 3, 0}, 1.5);
  for (int i = 0; i < 12; ++i) {
    CAPTURE(i);
    Patch patch = plane;
    for (Vector3d& p : patch.points) p.z() += 0.7 * kPlanarTolerance * 10 * rng.between(-1, 1);
    const QuadMesh mesh = convert(patch).mesh;
    const auto defect = find_defect(patch, mesh);
    CHECK_MESSAGE(!defect, (defect ? defect->what : ""));
  }
}

TEST_CASE("curved: coarse surfaces of few triangles") {
  Rng rng(24);
  for (const Patch& patch : {box({1, 1, 1}, 1, rng), sphere(1.2, rng), sphere(0.5, rng), tube(1, 0.3, 0.6, 0, rng),
                             cone(3, 1, 1), cone(6, 2, 1)}) {
    CAPTURE(patch.triangles.size());
    const QuadMesh mesh = convert(patch).mesh;
    check(patch, mesh);
  }
}

TEST_CASE("curved: where a thin tube turns sharply from triangle to triangle no quad is turned over") {
  constexpr Index kRows = 10;
  for (const std::uint64_t seed : {14, 15, 16}) {
    const auto place = [&](double u, double v) {
      const double angle = 2 * std::numbers::pi * u;
      return Vector3d(std::cos(angle), std::sin(angle), 1.2 * kRows * v);
    };
    const Patch patch = triangulated({.across = 4, .along = kRows, .jitter = 0.28, .closed_across = true}, place, seed);
    const QuadMesh mesh = convert(patch).mesh;
    QualityAccumulator quality;
    quality.add(patch, mesh);
    CHECK(quality.result().inverted == 0);
  }
}

TEST_CASE("curved: an odd boundary leaves one triangle, and creases change nothing about that") {
  Rng rng(25);
  for (int k = 0; k < 6; ++k) {
    Patch patch = pierced(k % 2 ? sphere(0.15, rng) : box({1, 1, 1}, 0.2, rng), {0, 0, 1}, 0.3 + 0.05 * k);
    const RegionCount count = count_regions(patch);
    const QuadMesh mesh = convert(patch).mesh;
    check(patch, mesh);
    CHECK(mesh.triangles.size() == count.odd);
  }
}

namespace {

/// Triangles over a grid of n by n cells: node (x, y) is x + (n + 1) y.
Patch dome(Index n) {
  Patch patch;
  for (Index y = 0; y <= n; ++y)
    for (Index x = 0; x <= n; ++x) {
      const double u = x - 0.5 * n, v = y - 0.5 * n;
      patch.points.emplace_back(u, v, -0.5 * (u * u + v * v) / n);
    }
  for (Index y = 0; y < n; ++y)
    for (Index x = 0; x < n; ++x) {
      const Index a = x + (n + 1) * y, b = a + 1, c = b + n + 1, d = a + n + 1;
      patch.triangles.push_back({a, b, (x + y) % 2 ? c : d});
      patch.triangles.push_back({(x + y) % 2 ? a : b, c, d});
    }
  return patch;
}

/// Quads of which some corner looks down.
std::size_t turned_over(const QuadMesh& mesh) {
  return std::size_t(std::count_if(mesh.quads.begin(), mesh.quads.end(), [&](const auto& quad) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto at = [&](std::size_t k) { return mesh.points[quad[(i + k) % 4]]; };
      if (!((at(1) - at(0)).cross(at(3) - at(0)).z() > 0)) return true;
    }
    return false;
  }));
}

}  // namespace

TEST_CASE("curved: where nodes of triangles have changed places no quad is turned over, or it is said where") {
  constexpr Index n = 8;
  int converted = 0;
  using Pair = std::array<Index, 2>;
  for (const Pair& pair :
       {Pair{40, 41}, Pair{40, 49}, Pair{40, 50}, Pair{21, 22}, Pair{30, 31}, Pair{60, 69}, Pair{40, 60}}) {
    const Index a = pair[0], b = pair[1];
    CAPTURE(a);
    CAPTURE(b);
    Patch patch = dome(n);
    std::swap(patch.points[a], patch.points[b]);
    for (const bool is_improved : {false, true}) {
      CAPTURE(is_improved);
      try {
        const QuadMesh mesh = (is_improved ? improve(patch) : convert(patch)).mesh;
        CHECK(turned_over(mesh) == 0);
        ++converted;
      } catch (const SurfaceError& error) {
        CHECK(error.place());
      }
    }
  }
  CHECK(converted >= 10);
}

TEST_CASE("curved: sharp edges around a node that is out of place are no creases where that puts the surface right") {
  Rng rng(5);
  const Patch coarse = torus(1, 0.4, 0.33, rng);  // many edges are sharper than 40 degrees
  int converted = 0, tried = 0;
  for (std::size_t t = 0; t < coarse.triangles.size() && tried < 12; t += 17, ++tried) {
    Patch patch = coarse;
    std::swap(patch.points[patch.triangles[t][0]], patch.points[patch.triangles[t][1]]);
    try {
      const QuadMesh mesh = convert(patch).mesh;
      CHECK(mesh.triangles.empty());
      CHECK(measure(mesh).scaled_jacobian_min > 0);
      ++converted;
    } catch (const SurfaceError& error) {
      CHECK(error.place());
    }
  }
  CHECK(converted >= tried - 1);
}

TEST_CASE("curved: tries end in time on what overlaps itself everywhere") {
  // In allowances: a try of something small begins before 8 are spent, and the last one is finished. That takes one for
  // the parts and, so few triangles have an allowance of 60000 each, eight times 61800 each for windows.
  constexpr double kBegins = 8, kParts = 1, kWindows = 8 * (1 + 1800.0 / 60000);
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Rng rng(seed);
    Patch patch = plate(6, 4);
    for (Vector3d& p : patch.points)
      for (double& x : p) x += rng.between(-3, 3);
    for (const chart::CurvedRegion& region : chart::curved_regions(patch, 0.7)) {
      const std::size_t size = region.region.triangles.size();
      Budget budget(budget_of_call(double(size)));
      try {
        chart::SharedDivision shared;
        chart::work_on_region(region, Options(), budget, chart::Task::convert, shared);
      } catch (const SurfaceError&) {
      }
      CHECK(budget.spent() < (kBegins + kParts + kWindows) * allowance(size));
    }
  }
}

TEST_CASE("curved: a division that was made for another front gives the same as one's own") {
  const Patch patch = torus({.across = 14, .along = 8, .jitter = 0.2});
  const auto regions = chart::curved_regions(patch, 0.7);
  REQUIRE(regions.size() == 1);
  chart::SharedDivision shared, other;
  const auto points = [&](chart::SharedDivision& division) {
    Budget budget(budget_of_call(double(patch.triangles.size())));
    const auto work = chart::try_region(regions[0], Options(), budget, chart::Task::convert, division);
    REQUIRE(work);
    return work->mesh.points;
  };
  const auto first = points(shared);
  REQUIRE(shared);
  const chart::SharedDivision made = shared;
  CHECK(points(shared) == first);
  CHECK(shared == made);
  CHECK(points(other) == first);
}

TEST_CASE("curved: what has no two sides is refused by name") {
  // A Moebius strip.
  const int n = 24;
  Patch patch;
  for (int k = 0; k < n; ++k)
    for (int side = -1; side <= 1; ++side) {
      const double a = 2 * std::numbers::pi * k / n;
      const double r = 1 + 0.25 * side * std::cos(a / 2);
      patch.points.emplace_back(r * std::cos(a), r * std::sin(a), 0.25 * side * std::sin(a / 2));
    }
  const auto node = [&](int k, int side) { return Index(3 * (k % n) + (k == n ? 1 - side : 1 + side)); };
  for (int k = 0; k < n; ++k)
    for (int side = -1; side <= 0; ++side) {
      patch.triangles.push_back({node(k, side), node(k + 1, side), node(k + 1, side + 1)});
      patch.triangles.push_back({node(k, side), node(k + 1, side + 1), node(k, side + 1)});
    }
  CHECK_THROWS_AS(convert(patch), SurfaceError);
}

namespace {

/// Two quads around the tip of a cone, and two rings of quads around them.
struct TipOfTwo {
  Patch patch = cone(4, 6, 3);
  Start start{patch};
  chart::SurfaceMesh mesh;
  Index tip = add(0, 0);
  std::vector<Index> rings[3];

  TipOfTwo() {
    mesh.fixed[tip] = 1;
    for (int ring = 0; ring < 3; ++ring)
      for (int k = 0; k < 4; ++k) rings[ring].push_back(add(1 + ring, std::numbers::pi / 2 * k));
    mesh.faces.push_back({tip, rings[0][0], rings[0][1], rings[0][2]});
    mesh.faces.push_back({tip, rings[0][2], rings[0][3], rings[0][0]});
    for (int ring = 0; ring < 2; ++ring)
      for (int k = 0; k < 4; ++k)
        mesh.faces.push_back(
            {rings[ring][k], rings[ring + 1][k], rings[ring + 1][(k + 1) % 4], rings[ring][(k + 1) % 4]});
    mesh.near.assign(mesh.faces.size(), 0);
    mesh.open.assign(4 * mesh.faces.size(), false);
    for (int k = 0; k < 4; ++k) mesh.open[4 * (6 + k) + 1] = true;
  }

  Index add(double r, double angle) { return mesh.add_point(at(r, angle), Index(0)); }
  static Eigen::Vector3d at(double r, double angle) { return {r * std::cos(angle), r * std::sin(angle), -3 * r}; }
};

}  // namespace

TEST_CASE("curved: a tip of a cone that two quads surround gets a third") {
  TipOfTwo two;
  chart::SurfaceMesh& mesh = two.mesh;
  const auto at_tip = [&] {
    return std::count_if(mesh.faces.begin(), mesh.faces.end(),
                         [&](const chart::Face& f) { return std::count(f.begin(), f.end(), two.tip) > 0; });
  };
  REQUIRE(at_tip() == 2);
  const auto widened = chart::with_wider_tips(mesh, {}, *two.start.region.background);
  REQUIRE(widened);
  mesh = *widened;
  CHECK(at_tip() == 3);
  CHECK(mesh.faces.size() == 11);
  std::size_t open = 0;
  for (Index other : chart::opposite_sides(mesh)) open += other == kNone;
  CHECK(open == 4);
  // All three fan out now.
  CHECK(!chart::with_wider_tips(mesh, {}, *two.start.region.background));
}

TEST_CASE("curved: what is sharp on a smooth surface is no crease") {
  Patch roof = plate(6, 4);
  for (Vector3d& p : roof.points)  // turned down by 100 degrees beyond its third column
    if (const double beyond = p.x() - 3; beyond > 0)
      p = {3 + beyond * std::cos(100 * std::numbers::pi / 180), p.y(),
           -beyond * std::sin(100 * std::numbers::pi / 180)};
  const double asked = Options{}.crease_angle;
  CHECK(chart::curved_regions(roof, space::crease_angle_of(roof, asked)).at(0).creases.size() == 4);
  check(roof, convert(roof).mesh);
  roof.is_smooth = true;
  CHECK(chart::curved_regions(roof, space::crease_angle_of(roof, asked)).at(0).creases.empty());
  check(roof, convert(roof).mesh);
}

TEST_CASE("curved: quads at the tip of a cone are good by their own normals, too") {
  for (const auto& [around, rings] : {std::pair(3, 9), std::pair(4, 6)}) {
    const QuadMesh mesh = convert(cone(around, rings, 3)).mesh;
    const auto at = [&](Index v) -> const Vector3d& { return mesh.points[v]; };
    for (const auto& q : mesh.quads) CHECK(space::own_sine<4>({at(q[0]), at(q[1]), at(q[2]), at(q[3])}) > 0.35);
  }
}
