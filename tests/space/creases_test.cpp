// SPDX-License-Identifier: GPL-2.0-or-later
// Sharp edges, and bends that are only coarse.
#include "space/creases.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "chart/fixture.hpp"

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::vector<std::pair<Index, Index>> creases(const Patch& patch, double degrees = 40) {
  const space::Background surface(patch.points, patch.triangles);
  return space::find_creases(surface, degrees * kDegree);
}

/// Strips of unit squares side by side, turned by these angles (degrees) one against the other.
Patch folded(const std::vector<double>& turns, int rows = 6) {
  const int strips = int(turns.size()) + 1;
  Patch patch = plate(strips, rows);
  std::vector<Vector3d> across{Vector3d::Zero()};
  double angle = 0;
  for (int i = 0; i < strips; ++i) {
    across.push_back(across.back() + Vector3d(std::cos(angle), 0, std::sin(angle)));
    if (i < int(turns.size())) angle += turns[i] * kDegree;
  }
  for (Vector3d& p : patch.points) p = across[std::size_t(p.x())] + Vector3d(0, p.y(), 0);
  return patch;
}

}  // namespace

TEST_CASE("creases: the edges of a box, and no others") {
  Rng rng(5);
  const Patch patch = box({1, 1.5, 2}, 0.25, rng);
  const auto found = creases(patch);
  std::set<std::pair<Index, Index>> wanted;
  const auto faces_at = [&](Index v) {  // bits of the faces that a node lies on
    int bits = 0;
    const Vector3d high(1, 1.5, 2);
    for (int k = 0; k < 3; ++k) {
      if (patch.points[v][k] == 0) bits |= 1 << (2 * k);
      if (patch.points[v][k] == high[k]) bits |= 2 << (2 * k);
    }
    return bits;
  };
  for (const auto& t : patch.triangles)
    for (int i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      if (std::popcount(unsigned(faces_at(a) & faces_at(b))) == 2) wanted.insert(std::minmax(a, b));
    }
  CHECK(std::set(found.begin(), found.end()) == wanted);
  CHECK(creases(patch, 91).empty());
  CHECK(creases(patch, 180).empty());
}

TEST_CASE("creases: a fold between planes is one if it is sharper than the angle") {
  CHECK(creases(folded({0, 0, 45, 0, 0})).size() == 6);
  CHECK(creases(folded({0, 0, 39, 0, 0})).empty());
  CHECK(creases(folded({0, 0, 39, 0, 0}), 30).size() == 6);
  CHECK(creases(folded({0, 0, -60, 0, 0})).size() == 6);
  CHECK(creases(folded({0, 0, 120, 0, 0})).size() == 6);
  CHECK(creases(folded({0, 50, 0, -50, 0})).size() == 12);
}

TEST_CASE("creases: the edges of a coarsely meshed bend are none") {
  CHECK(creases(folded({45, 45, 45, 45, 45, 45})).empty());
  CHECK(creases(folded({0, 22.5, 45, 22.5, 0})).empty());
  Rng rng(2);
  for (const double radius : {0.4, 0.6}) CHECK(creases(tube(4, radius, 0.5, 0, rng)).empty());
  CHECK(creases(sphere(1, rng)).empty());
}

TEST_CASE("creases: a triangle without height does not decide") {
  Patch patch = plate(4, 4);
  patch.points[12] = {2.9999, 2, 0.0005};  // its neighbour on one side is a needle that stands on end
  CHECK(creases(patch, 60).empty());
}

namespace {

/// Rings around the tip of a cone, each with twice as many edges as the one before. `ring`: directions of the nodes of
/// the first (turns), from 0 on. With a seam, nodes at 0 are there twice.
Patch cone_tip(std::vector<double> ring, bool has_seam) {
  Patch patch;
  patch.points.emplace_back(0, 0, 0);
  const int around = int(ring.size());
  ring.push_back(1);
  std::vector<Index> inner(1, 0);
  for (int r = 1, count = around; r <= 4; ++r, count *= 2) {
    std::vector<Index> outer;
    for (int i = 0; i < count + has_seam; ++i) {
      outer.push_back(Index(patch.points.size()));
      const int k = i % count * around / count;
      const double share = double(i % count * around % count) / count;
      const double angle =
          2 * std::numbers::pi * (ring[std::size_t(k)] + share * (ring[std::size_t(k) + 1] - ring[std::size_t(k)]));
      patch.points.emplace_back(r * std::cos(angle), r * std::sin(angle), -3.0 * r);
    }
    const auto out = [&](int i) { return outer[std::size_t(i) % outer.size()]; };
    const auto in = [&](int i) { return inner[std::size_t(i) % inner.size()]; };
    for (int i = 0; i < count; ++i) {
      if (r == 1) {
        patch.triangles.push_back({0, out(i), out(i + 1)});
      } else if (i % 2 == 0) {
        patch.triangles.push_back({in(i / 2), out(i), out(i + 1)});
      } else {
        patch.triangles.push_back({in(i / 2), out(i), in(i / 2 + 1)});
        patch.triangles.push_back({in(i / 2 + 1), out(i), out(i + 1)});
      }
    }
    inner = outer;
  }
  return patch;
}

}  // namespace

TEST_CASE("creases: what few triangles make of the tip of a cone is none") {
  CHECK(creases(cone_tip({0, 1.0 / 3, 2.0 / 3}, false)).empty());
  CHECK(creases(cone_tip({0, 0.25, 0.5, 0.75}, false)).empty());
  CHECK(creases(cone_tip({0, 0.2, 0.4, 0.6, 0.8}, false)).empty());
  // With a seam, which ends there. One edge inside is sharp, or more.
  CHECK(creases(cone_tip({0, 1.0 / 3, 2.0 / 3}, true)).empty());
  CHECK(creases(cone_tip({0, 0.5}, true)).empty());
  CHECK(creases(cone_tip({0, 0.07, 0.55}, true)).empty());
  CHECK(creases(cone_tip({0, 0.1, 0.6, 0.9}, true)).empty());
}
