// SPDX-License-Identifier: GPL-2.0-or-later
// Random domains whose triangles are stretched, all alike or around a circle: what the quads are worth is measured where
// nothing is stretched. Rolled up, they are worth what they are flat.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>

#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"
#include "quality/directed_size.hpp"
#include "support/domains.hpp"
#include "support/invariants.hpp"
#include "support/seeds.hpp"
#include "support/surfaces.hpp"

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;

namespace {

/// A map of a domain's plane, and back.
struct Map {
  std::function<Vector3d(const Vector3d&)> to, from;
};

/// A domain of many triangles, turned into the plane z = 0, its centre at 0. Nothing if it has too few.
std::optional<Patch> large_domain(std::uint64_t seed) {
  constexpr std::size_t kLarge = 250;
  Patch patch = random_domain(seed).patch;
  if (patch.triangles.size() < kLarge || !patch.quads.empty()) return {};
  Vector3d normal = Vector3d::Zero(), centre = Vector3d::Zero();
  for (const auto& [a, b, c] : patch.triangles)
    normal += (patch.points[b] - patch.points[a]).cross(patch.points[c] - patch.points[a]);
  const double size = std::sqrt(normal.norm());
  for (const Vector3d& p : patch.points) centre += p / double(patch.points.size());
  const auto turn = Eigen::Quaterniond::FromTwoVectors(normal, Vector3d::UnitZ());
  for (Vector3d& p : patch.points) {
    p = turn * (p - centre) / size;
    p.z() = 0;
  }
  return patch;
}

Map stretching(double ratio) {
  return {[=](const Vector3d& p) { return Vector3d(p.x(), p.y() / ratio, 0); },
          [=](const Vector3d& p) { return Vector3d(p.x(), p.y() * ratio, 0); }};
}

/// Around a circle; across, all is thinner.
Map bending(double ratio, double radius) {
  return {[=](const Vector3d& p) {
            const double r = radius + p.y() / ratio, angle = p.x() / radius;
            return Vector3d(r * std::sin(angle), r * std::cos(angle), 0);
          },
          [=](const Vector3d& p) {
            const double r = std::hypot(p.x(), p.y()), angle = std::atan2(p.x(), p.y());
            return Vector3d(radius * angle, (r - radius) * ratio, 0);
          }};
}

Patch mapped(Patch patch, const std::function<Vector3d(const Vector3d&)>& map) {
  for (Vector3d& p : patch.points) p = map(p);
  return patch;
}

bool has_turned_over(const Patch& patch) {
  for (const auto& [a, b, c] : patch.triangles)
    if ((patch.points[b] - patch.points[a]).cross(patch.points[c] - patch.points[a]).z() <= 0) return true;
  return false;
}

/// Sums over domains.
struct Pool {
  double quads = 0, shapes = 0, nodes = 0, irregular = 0;
  void add(const QuadMesh& mesh) {
    const Quality quality = measure(mesh);
    quads += double(quality.quads);
    shapes += quality.scaled_jacobian_mean * double(quality.quads);
    nodes += double(quality.interior_nodes);
    irregular += double(quality.irregular_nodes);
  }
  double mean() const { return shapes / quads; }
  double irregular_share() const { return irregular / nodes; }
};

struct Pools {
  Pool plain, stretched;
  std::size_t domains = 0, kept = 0, alike = 0;

  void add(const Patch& patch, const Map& map) {
    Options options;
    options.retry_triangles = 0;
    const Patch there = mapped(patch, map.to);
    if (has_turned_over(there)) return;  // an edge that is too long for the bend
    const QuadMesh mesh = convert(there, options).mesh;
    const auto broken = broken_invariants(there, mesh);
    CHECK_MESSAGE(broken.empty(), broken.front());
    const QuadMesh plain_mesh = convert(patch, options).mesh;
    plain.add(plain_mesh);
    QuadMesh back = mesh;
    for (Vector3d& p : back.points) p = map.from(p);
    stretched.add(back);
    ++domains;
    alike += measure(back).scaled_jacobian_mean > measure(plain_mesh).scaled_jacobian_mean - 0.06;
    const double size = largest_ratio(median(directed_sizes(there, mesh.points, mesh.quads)));
    kept += size <= std::max(kLargestSizeRatio,
                             largest_ratio(median(directed_sizes(patch, plain_mesh.points, plain_mesh.quads))));
  }
};

}  // namespace

TEST_CASE("stretched domains become what they become unstretched, stretched") {
  Pools pools;
  for (std::uint64_t seed = 0; seed < seeds(150, 40); ++seed) {
    const auto patch = large_domain(seed);
    if (!patch) continue;
    CAPTURE(seed);
    pools.add(*patch, stretching(std::array{5.0, 10.0, 30.0, 100.0}[seed % 4]));
  }
  REQUIRE(pools.domains > 5);
  CHECK(pools.stretched.mean() > 0.96 * pools.plain.mean());
  CHECK(pools.stretched.irregular_share() < 1.2 * pools.plain.irregular_share());
  CHECK(double(pools.alike) > 0.85 * double(pools.domains));
  CHECK(pools.stretched.quads == doctest::Approx(pools.plain.quads).epsilon(0.05));
  CHECK(double(pools.kept) > 0.9 * double(pools.domains));
}

TEST_CASE("domains that are stretched around a circle become quads that are stretched around it") {
  Pools pools;
  for (std::uint64_t seed = 0; seed < seeds(150, 100); ++seed) {
    const auto patch = large_domain(seed);
    if (!patch) continue;
    double reach = 0;
    for (const Vector3d& p : patch->points) reach = std::max(reach, p.norm());
    CAPTURE(seed);
    pools.add(*patch, bending(std::array{5.0, 10.0}[seed % 2], reach));
  }
  REQUIRE(pools.domains > 5);
  // Some have no chart, because what is between their holes does not close, and few have no valid result.
  CHECK(pools.stretched.mean() > 0.9 * pools.plain.mean());
  CHECK(double(pools.alike) > 0.6 * double(pools.domains));
  CHECK(pools.stretched.quads == doctest::Approx(pools.plain.quads).epsilon(0.1));
  CHECK(double(pools.kept) > 0.9 * double(pools.domains));
}

TEST_CASE("stretched domains that are rolled onto cylinders and cones come out as they do in the plane") {
  Pool flat, bent;
  std::size_t domains = 0, kept = 0;
  for (std::uint64_t seed = 0; seed < seeds(150, 40); ++seed) {
    const auto patch = large_domain(seed);
    if (!patch) continue;
    CAPTURE(seed);
    Options options;
    options.retry_triangles = 0;
    Rng rng(seed);
    const Patch there = mapped(*patch, stretching(std::array{5.0, 10.0, 20.0}[seed % 3]).to);
    const Patch rolled_up = rolled(there, seed % 2 ? rng.between(0.3, 0.9) : 0, rng);
    const QuadMesh plane = convert(there, options).mesh, curved = convert(rolled_up, options).mesh;
    const auto broken = broken_invariants(rolled_up, curved);
    CHECK_MESSAGE(broken.empty(), broken.front());
    flat.add(plane);
    bent.add(curved);
    ++domains;
    kept += largest_ratio(median(directed_sizes(rolled_up, curved.points, curved.quads))) <=
            std::max(kLargestSizeRatio, largest_ratio(median(directed_sizes(there, plane.points, plane.quads))));
  }
  REQUIRE(domains > 5);
  CHECK(bent.mean() > 0.95 * flat.mean());
  CHECK(bent.quads == doctest::Approx(flat.quads).epsilon(0.05));
  CHECK(bent.irregular_share() < 1.2 * flat.irregular_share() + 0.004);
  CHECK(double(kept) > 0.9 * double(domains));
}

TEST_CASE("stretched domains: one thread and two make the same bytes") {
  for (std::uint64_t seed = 0; seed < seeds(40, 20); ++seed) {
    auto patch = large_domain(seed);
    if (!patch) continue;
    patch = mapped(*patch, bending(5, 2).to);
    if (has_turned_over(*patch)) continue;
    Rng rng(seed);
    if (seed % 2) patch = rolled(*patch, 0, rng);
    Options options;
    options.threads = 1;
    const QuadMesh one = convert(*patch, options).mesh;
    options.threads = 2;
    const QuadMesh two = convert(*patch, options).mesh;
    CAPTURE(seed);
    REQUIRE(one.points.size() == two.points.size());
    CHECK(one.quads == two.quads);
    CHECK(std::memcmp(one.points.data(), two.points.data(), sizeof(Vector3d) * one.points.size()) == 0);
  }
}
