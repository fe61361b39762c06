// Small regions that come out poor are tried again with other constants of the front.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "qmorph/convert.hpp"
#include "support/domains.hpp"
#include "support/invariants.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// What a try is judged by: smallest scaled Jacobian, where it is under 0.4, + twice the mean metric of the thesis.
double worth(const QuadMesh& mesh, const Eigen::Vector3d& normal) {
  double least = 1, shapes = 0;
  for (const auto& q : mesh.quads) {
    double shape = 1;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d p = mesh.points[q[i]], a = mesh.points[q[(i + 1) % 4]] - p,
                            b = mesh.points[q[(i + 3) % 4]] - p;
      const double area = a.cross(b).dot(normal);
      least = std::min(least, area / (a.norm() * b.norm()));
      shape = std::min(shape, 4 * area / (a.squaredNorm() + b.squaredNorm() + (a - b).squaredNorm()));
    }
    shapes += shape;
  }
  return std::min(least, 0.4) + 2 * shapes / double(mesh.quads.size());
}

/// Random domains of one region with an even boundary and few triangles.
std::vector<Patch> small_regions(std::size_t most_triangles, std::size_t wanted) {
  std::vector<Patch> patches;
  for (std::uint64_t seed = 0; patches.size() < wanted && seed < 1000; ++seed) {
    const Patch patch = random_domain(seed).patch;
    if (patch.triangles.size() > most_triangles || patch.triangles.size() < 10 || !patch.quads.empty()) continue;
    const RegionCount regions = count_regions(patch);
    if (regions.regions == 1 && regions.odd == 0) patches.push_back(patch);
  }
  return patches;
}

QuadMesh convert_with(const Patch& patch, std::size_t retry_triangles) {
  Options options;
  options.retry_triangles = retry_triangles;
  return convert(patch, options);
}

bool is_same(const QuadMesh& a, const QuadMesh& b) {
  return a.points == b.points && a.quads == b.quads && a.triangles == b.triangles && a.source == b.source;
}

}  // namespace

TEST_CASE("convert region: with tries of other constants a small region is never worse, sometimes better") {
  const std::size_t tries = Options{}.retry_triangles;
  int better = 0;
  const auto patches = small_regions(300, 25);
  REQUIRE(patches.size() == 25);
  for (const Patch& patch : patches) {
    const Eigen::Vector3d normal = area_vector(patch.points, patch.triangles, patch.quads).normalized();
    const QuadMesh without = convert_with(patch, 0), with = convert_with(patch, tries);
    const double gain = worth(with, normal) - worth(without, normal);
    CHECK(gain > -1e-9);
    better += gain > 1e-3;
    CHECK(broken_invariants(patch, with).empty());
    CHECK(is_same(with, convert_with(patch, tries)));
  }
  CHECK(better > 3);
}

TEST_CASE("convert region: a region whose second try would take more triangles than allowed gets one only") {
  for (const Patch& patch : small_regions(300, 8)) {
    const std::size_t too_few = 2 * patch.triangles.size() - 1;
    CHECK(is_same(convert_with(patch, too_few), convert_with(patch, 0)));
  }
}

TEST_CASE("convert region: a good result is not tried again") {
  Patch patch;
  constexpr Index kCells = 8;
  for (Index y = 0; y <= kCells; ++y)
    for (Index x = 0; x <= kCells; ++x) patch.points.emplace_back(x, y, 0);
  for (Index y = 0; y < kCells; ++y)
    for (Index x = 0; x < kCells; ++x) {
      const Index a = x + y * (kCells + 1), d = a + kCells + 1;
      patch.triangles.push_back({a, a + 1, d + 1});
      patch.triangles.push_back({a, d + 1, d});
    }
  const QuadMesh mesh = convert_with(patch, 100000);
  CHECK(is_same(mesh, convert_with(patch, 0)));
  CHECK(worth(mesh, Eigen::Vector3d::UnitZ()) == doctest::Approx(2.4));
}
