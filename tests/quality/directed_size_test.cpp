// SPDX-License-Identifier: GPL-2.0-or-later
#include "quality/directed_size.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace {

using Eigen::Vector3d;
using qmorph::DirectedSize;
using qmorph::Index;
using qmorph::Patch;

/// n by n cells of these lengths, turned and put somewhere into space.
template <class Mesh>
Mesh nodes(Index n, double length, double height) {
  const Vector3d x = Vector3d(1, 2, -1).normalized(), y = Vector3d(2, 0, 2).normalized();
  Mesh mesh;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) mesh.points.push_back(Vector3d(5, 6, 7) + i * length * x + j * height * y);
  return mesh;
}

Patch triangles(Index n, double length, double height) {
  auto patch = nodes<Patch>(n, length, height);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, d = a + n + 1;
      patch.triangles.insert(patch.triangles.end(), {{a, a + 1, d}, {a + 1, d + 1, d}});
    }
  return patch;
}

DirectedSize compare(const Patch& before, Index n, double length, double height) {
  auto after = nodes<qmorph::QuadMesh>(n, length, height);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i;
      after.quads.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return qmorph::median(qmorph::directed_sizes(before, after.points, after.quads));
}

}  // namespace

TEST_CASE("directed sizes: rectangles are as long as the triangles that they were made of, however flat they are") {
  for (const double length : {1.0, 5.0, 1e2, 1e4}) {
    const DirectedSize size = compare(triangles(40, length, 1), 40, length, 1);
    CAPTURE(length);
    CHECK(size.along == doctest::Approx(1).epsilon(0.01));
    CHECK(size.across == doctest::Approx(1).epsilon(0.01));
  }
}

TEST_CASE("directed sizes: a loss across the stretch alone is seen as such") {
  const DirectedSize size = compare(triangles(40, 20, 1), 10, 80, 4);
  CHECK(size.along == doctest::Approx(4).epsilon(0.02));
  CHECK(size.across == doctest::Approx(4).epsilon(0.02));
  const DirectedSize across = compare(triangles(40, 20, 1), 20, 20, 8);
  CHECK(across.along == doctest::Approx(1).epsilon(0.02));
  CHECK(across.across == doctest::Approx(8).epsilon(0.02));
  CHECK(qmorph::largest_ratio(across) == doctest::Approx(8).epsilon(0.02));
  CHECK(qmorph::largest_ratio({0.25, 1.1}) == doctest::Approx(4));
}

TEST_CASE(
    "directed sizes: a sample of a few hundred of ten thousand triangles is enough, and an empty mesh has no size") {
  const Patch patch = triangles(80, 3, 1);
  auto after = nodes<qmorph::QuadMesh>(80, 3, 1);
  CHECK(qmorph::directed_sizes(patch, after.points, {}).empty());
  CHECK(qmorph::median({}).along == 1);
  after.quads.push_back({0, 1, 82, 81});
  CHECK(qmorph::directed_sizes(patch, after.points, after.quads).size() <= 2);
}
