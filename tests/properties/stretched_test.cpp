// SPDX-License-Identifier: GPL-2.0-or-later
// Random domains whose triangles are stretched, all alike or around a circle: what the quads are worth is measured
// where nothing is stretched. The same on cylinders.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <optional>

#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"
#include "quality/directed_size.hpp"
#include "support/domains.hpp"
#include "support/invariants.hpp"
#include "support/pool.hpp"
#include "support/rng.hpp"
#include "support/seeds.hpp"

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

/// Onto a cylinder of this radius around the x axis, and back.
Map rolling(double ratio, double radius) {
  const Map flat = stretching(ratio);
  return {[=](const Vector3d& p) {
            const Vector3d q = flat.to(p);
            return Vector3d(q.x(), radius * std::sin(q.y() / radius), radius * std::cos(q.y() / radius));
          },
          [=](const Vector3d& p) {
            return flat.from({p.x(), radius * std::atan2(p.y(), p.z()), 0});
          }};
}

double largest(const Patch& patch, Eigen::Index axis) {
  double most = 0;
  for (const Vector3d& p : patch.points) most = std::max(most, std::abs(p[axis]));
  return most;
}

/// Long sides run along the cylinder, which is as round as the domain is wide.
Map rolled_along(const Patch& patch, double ratio) { return rolling(ratio, largest(patch, 1) / ratio); }

/// Long sides run around the cylinder, which is so large that they lie near it in comparison with their triangles.
Map rolled_across(const Patch& patch, double ratio) {
  constexpr double kNear = 0.1;  // of the width of a triangle
  double longest2 = 0;
  for (const auto& [a, b, c] : patch.triangles)
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      longest2 = std::max(longest2, (patch.points[p] - patch.points[q]).squaredNorm());
  const double radius = ratio * std::max(largest(patch, 0), std::sqrt(longest2) * ratio / (8 * kNear));
  const Map along = rolling(1 / ratio, radius);
  const auto turned = [=](const Vector3d& p) { return Vector3d(-p.y(), p.x(), 0); };
  return {[=](const Vector3d& p) { return Vector3d(along.to(turned(p)) / ratio); },
          [=](const Vector3d& p) {
            const Vector3d q = along.from(p * ratio);
            return Vector3d(q.y(), -q.x(), 0);
          }};
}

bool has_turned_over(const Patch& patch) {
  const bool is_flat = largest(patch, 2) == 0;
  for (const auto& [a, b, c] : patch.triangles)
    if (is_flat && (patch.points[b] - patch.points[a]).cross(patch.points[c] - patch.points[a]).z() <= 0) return true;
  return false;
}

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

/// A tube around the z axis of rows of equal triangles, their nodes jittered a little; no node inside is special.
Patch stretched_tube(int around, int along, double width, double height, std::uint64_t seed) {
  Rng rng(seed);
  Patch patch;
  const double radius = around * width / (2 * std::numbers::pi), row = height * std::sqrt(3.0) / 2;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double jitter = j > 0 && j < along ? 0.2 : 0;
      const double u = i + 0.5 * (j % 2) + rng.between(-jitter, jitter), v = j + rng.between(-jitter, jitter);
      const double angle = u * width / radius;
      patch.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), v * row);
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const auto node = [&](int k, int level) { return Index(level * around + (k + around) % around); };
      const int shift = j % 2;  // of the next row against this one
      patch.triangles.push_back({node(i, j), node(i + 1, j), node(i + shift, j + 1)});
      patch.triangles.push_back({node(i, j), node(i + shift, j + 1), node(i + shift - 1, j + 1)});
    }
  return patch;
}

}  // namespace

TEST_CASE("stretched domains become what they become unstretched, stretched") {
  Pools pools;
  for (std::uint64_t seed = 0; seed < seeds(150); ++seed) {
    const auto patch = large_domain(seed);
    if (!patch) continue;
    CAPTURE(seed);
    pools.add(*patch, stretching(std::array{5.0, 10.0, 30.0, 100.0}[seed % 4]));
  }
  if (!allows_laws(seeds(150))) return;
  REQUIRE(pools.domains > 5);
  CHECK(pools.stretched.mean() > 0.96 * pools.plain.mean());
  CHECK(pools.stretched.irregular_share() < 1.2 * pools.plain.irregular_share());
  CHECK(double(pools.alike) > 0.85 * double(pools.domains));
  CHECK(pools.stretched.quads == doctest::Approx(pools.plain.quads).epsilon(0.05));
  CHECK(double(pools.kept) > 0.9 * double(pools.domains));
}

TEST_CASE("domains that are stretched around a circle become quads that are stretched around it") {
  Pools pools;
  for (std::uint64_t seed = 0; seed < seeds(150); ++seed) {
    const auto patch = large_domain(seed);
    if (!patch) continue;
    double reach = 0;
    for (const Vector3d& p : patch->points) reach = std::max(reach, p.norm());
    CAPTURE(seed);
    pools.add(*patch, bending(std::array{5.0, 10.0}[seed % 2], reach));
  }
  if (!allows_laws(seeds(150))) return;
  REQUIRE(pools.domains > 5);
  // Some have no chart, because what is between their holes does not close, and few have no valid result.
  CHECK(pools.stretched.mean() > 0.9 * pools.plain.mean());
  CHECK(double(pools.alike) > 0.6 * double(pools.domains));
  CHECK(pools.stretched.quads == doctest::Approx(pools.plain.quads).epsilon(0.1));
  CHECK(double(pools.kept) > 0.9 * double(pools.domains));
}

TEST_CASE("stretched domains that are rolled up become what they become flat") {
  Pools flat, bent;
  for (std::uint64_t seed = 0; seed < seeds(150); ++seed) {
    const auto patch = large_domain(seed);
    if (!patch) continue;
    CAPTURE(seed);
    const double ratio = std::array{5.0, 10.0, 20.0}[seed % 3];
    flat.add(*patch, stretching(ratio));
    bent.add(*patch, seed % 2 ? rolled_along(*patch, ratio) : rolled_across(*patch, ratio));
  }
  if (!allows_laws(seeds(150))) return;
  REQUIRE(bent.domains > 5);
  CHECK(bent.stretched.mean() > 0.97 * flat.stretched.mean());
  CHECK(bent.stretched.irregular_share() < 1.2 * flat.stretched.irregular_share() + 0.004);
  CHECK(bent.stretched.quads == doctest::Approx(flat.stretched.quads).epsilon(0.05));
  CHECK(bent.kept + bent.domains / 10 >= flat.kept);
}

TEST_CASE("a tube without a line keeps how it is stretched, along it and around") {
  struct Case {
    int around, along;
    double width, height;  // of a triangle
  };
  for (const Case& tube : {Case{120, 20, 0.3, 3}, Case{70, 100, 3, 0.3}}) {
    Pool pool;
    const std::uint64_t tubes = seeds(8, 2);
    for (std::uint64_t seed = 0; seed < tubes; ++seed) {
      const Patch patch = stretched_tube(tube.around, tube.along, tube.width, tube.height, seed);
      const QuadMesh mesh = convert(patch, Options()).mesh;
      CAPTURE(seed);
      if (seed == 0 && tube.around > tube.along) {  // the other is large: it would take long
        const auto broken = broken_invariants(patch, mesh);
        CHECK_MESSAGE(broken.empty(), broken.front());
      }
      CHECK(mesh.triangles.empty());
      CHECK(largest_ratio(median(directed_sizes(patch, mesh.points, mesh.quads))) < 1.15);
      pool.add(mesh);
    }
    if (tubes < 8) continue;  // too few for laws about sums
    CHECK(pool.mean() > 0.9);
    CHECK(pool.irregular_share() < 0.01);
  }
}

TEST_CASE("rows of triangles that stand off a tube as pleats become quads all the same") {
  struct Case {
    int around, along;
    double width, height, kept;
  };
  for (const Case& tube : {Case{24, 20, 3, 0.3, 1.5}, Case{16, 20, 3, 0.3, 1.5}, Case{40, 12, 9, 0.3, 3}}) {
    const Patch patch = stretched_tube(tube.around, tube.along, tube.width, tube.height, 1);
    CAPTURE(tube.around);
    const QuadMesh mesh = convert(patch, Options()).mesh;
    const auto broken = broken_invariants(patch, mesh);
    CHECK_MESSAGE(broken.empty(), broken.front());
    CHECK(mesh.triangles.empty());
    CHECK(largest_ratio(median(directed_sizes(patch, mesh.points, mesh.quads))) < tube.kept);
  }
}

TEST_CASE("stretched domains: one thread and two make the same bytes") {
  for (std::uint64_t seed = 0; seed < seeds(40, 4); ++seed) {
    auto patch = large_domain(seed);
    if (!patch) continue;
    patch = mapped(*patch, bending(5, 2).to);
    if (has_turned_over(*patch)) continue;
    if (seed % 2) patch = mapped(*patch, rolled_across(*patch, 1).to);
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
