// SPDX-License-Identifier: GPL-2.0-or-later
// The laws of the engine, on random domains. Re-run one seed with: qmorph_campaign SEED SEED
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "qmorph/convert.hpp"
#include "support/domains.hpp"
#include "support/invariants.hpp"
#include "support/nasty.hpp"
#include "support/seeds.hpp"

namespace {

using qmorph::Patch;
using qmorph::QuadMesh;
using qmorph::test::Domain;
using qmorph::test::random_domain;
using qmorph::test::Rng;
using qmorph::test::seeds;

/// What does not hold for the conversion of a patch; an exception is one line too.
std::vector<std::string> broken_conversion(const Patch& patch, QuadMesh* result = nullptr,
                                           const qmorph::Options& options = {}) {
  try {
    auto [mesh, report] = qmorph::convert(patch, options);
    auto broken = qmorph::test::broken_invariants(patch, mesh);
    const auto regions = qmorph::test::count_regions(patch);
    if (report.regions != regions.regions || report.odd_regions != regions.odd)
      broken.push_back("report: regions " + std::to_string(report.regions) + ", odd " +
                       std::to_string(report.odd_regions) + "; they are " + std::to_string(regions.regions) + " and " +
                       std::to_string(regions.odd));
    if (result) *result = std::move(mesh);
    return broken;
  } catch (const std::exception& e) {
    return {std::string("exception: ") + e.what()};
  }
}

/// Tries with other constants take most of the time; some domains are enough for them.
qmorph::Options options_for(std::uint64_t seed) {
  qmorph::Options options;
  if (seed % 10 != 0) options.retry_triangles = 0;
  return options;
}

bool same_topology(const QuadMesh& a, const QuadMesh& b) {
  return a.quads == b.quads && a.triangles == b.triangles && a.source == b.source;
}

bool same_bytes(const QuadMesh& a, const QuadMesh& b) {
  return same_topology(a, b) && a.points.size() == b.points.size() &&
         std::memcmp(a.points.data(), b.points.data(), sizeof(Eigen::Vector3d) * a.points.size()) == 0;
}

}  // namespace

TEST_CASE("1000 random domains convert without breaking an invariant") {
  for (std::uint64_t seed = 0; seed < seeds(1000); ++seed) {
    const Domain domain = random_domain(seed);
    const auto broken = broken_conversion(domain.patch, nullptr, options_for(seed));
    if (broken.empty()) continue;
    CAPTURE(seed);
    CAPTURE(domain.kind);
    FAIL_CHECK(broken.front());
  }
}

TEST_CASE("nasty domains convert without breaking an invariant") {
  for (std::uint64_t seed = 0; seed < seeds(300); ++seed) {
    const Domain domain = qmorph::test::nasty_domain(seed);
    const auto broken = broken_conversion(domain.patch, nullptr, options_for(seed));
    if (broken.empty()) continue;
    CAPTURE(seed);
    CAPTURE(domain.kind);
    FAIL_CHECK(broken.front());
  }
}

TEST_CASE(
    "random domains in small parts convert without breaking an invariant, to the same bytes on one thread and two") {
  for (std::uint64_t seed = 0; seed < seeds(200); ++seed) {
    const Domain domain = random_domain(seed);
    qmorph::Options options = options_for(seed);
    options.part_triangles = 30 + seed % 200;
    options.threads = 1;
    QuadMesh first, second;
    auto broken = broken_conversion(domain.patch, &first, options);
    options.threads = 2;
    if (broken.empty()) broken = broken_conversion(domain.patch, &second, options);
    if (broken.empty() && !same_bytes(first, second)) broken.push_back("two threads make another mesh than one");
    if (broken.empty()) continue;
    CAPTURE(seed);
    CAPTURE(domain.kind);
    FAIL_CHECK(broken.front());
  }
}

TEST_CASE("random domains: those that were once refused, or took very long, convert") {
  for (const std::uint64_t seed : {1144, 1526, 3827, 4193, 5229, 5282, 9161}) {
    const auto broken = broken_conversion(random_domain(seed).patch, nullptr, options_for(seed));
    CAPTURE(seed);
    CHECK_MESSAGE(broken.empty(), broken.front());
  }
}

TEST_CASE("random domains: a try of other constants that goes wrong is given up") {
  const auto broken = broken_conversion(random_domain(5308).patch);  // took more than 20 s once
  CHECK_MESSAGE(broken.empty(), broken.front());
}

TEST_CASE("random domains: two conversions of one patch are the same, byte for byte") {
  for (std::uint64_t seed = 0; seed < seeds(200); ++seed) {
    const Patch patch = random_domain(seed).patch;
    QuadMesh first, second;
    const auto broken = broken_conversion(patch, &first, options_for(seed));
    if (!broken.empty()) continue;                                                 // said by the test above
    broken_conversion(random_domain(seed + 1).patch, nullptr, options_for(seed));  // what comes between leaves no trace
    broken_conversion(patch, &second, options_for(seed));
    CAPTURE(seed);
    CHECK(same_bytes(first, second));
  }
}

TEST_CASE("random domains: each operation of each stage leaves valid elements, and checking that changes nothing") {
  for (std::uint64_t seed = 0; seed < seeds(100); ++seed) {
    const Patch patch = random_domain(seed).patch;
    QuadMesh plain;
    if (patch.triangles.size() > 400 || !broken_conversion(patch, &plain, options_for(seed)).empty()) continue;
    CAPTURE(seed);
    qmorph::Options options = options_for(seed);
    options.check_each_step = true;
    try {
      CHECK(same_bytes(plain, qmorph::convert(patch, options).mesh));
    } catch (const std::logic_error& e) {
      FAIL_CHECK(e.what());
    }
  }
}

TEST_CASE("random domains: a power of two in scale changes no decision") {
  for (std::uint64_t seed = 0; seed < seeds(150); ++seed) {
    const Patch patch = random_domain(seed).patch;
    QuadMesh plain, scaled;
    if (!broken_conversion(patch, &plain, options_for(seed)).empty()) continue;
    for (const double scale : {0x1p-30, 0.5, 0x1p30}) {
      CAPTURE(seed);
      CAPTURE(scale);
      const auto broken =
          broken_conversion(qmorph::test::moved(patch, scale, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()),
                            &scaled, options_for(seed));
      CHECK_MESSAGE(broken.empty(), broken.front());
      CHECK(same_topology(plain, scaled));
    }
  }
}

TEST_CASE("random domains: moved, turned, turned over or renumbered, the laws hold all the same") {
  for (std::uint64_t seed = 0; seed < seeds(150); ++seed) {
    const Domain domain = random_domain(seed);
    Rng rng(~seed);
    const Eigen::Matrix3d still = Eigen::Matrix3d::Identity();
    const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    const double size = (domain.patch.points.back() - domain.patch.points.front()).norm();
    const Eigen::Vector3d shift = size * Eigen::Vector3d(rng.between(-3, 3), rng.between(-3, 3), rng.between(-3, 3));
    const std::pair<std::string, Patch> variants[] = {
        {"shifted", qmorph::test::moved(domain.patch, 1, still, shift)},
        {"turned", qmorph::test::moved(domain.patch, 1, qmorph::test::random_rotation(rng), origin)},
        {"scaled", qmorph::test::moved(domain.patch, rng.between(0.1, 10), still, origin)},
        {"turned over", qmorph::test::turned_over(domain.patch)},
        {"renumbered", qmorph::test::renumbered(domain.patch, rng)},
    };
    for (const auto& variant : variants) {
      const auto broken = broken_conversion(variant.second, nullptr, options_for(seed));
      if (broken.empty()) continue;
      CAPTURE(seed);
      CAPTURE(domain.kind);
      CAPTURE(variant.first);
      FAIL_CHECK(broken.front());
    }
  }
}
