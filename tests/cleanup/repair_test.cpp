// SPDX-License-Identifier: GPL-2.0-or-later
// Elements that no smoothing can help get other neighbours.
#include "cleanup/repair.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "cleanup/spoilt_grid.hpp"
#include "kernel/fixture.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

constexpr double kDegree = std::numbers::pi / 180;

Vec2 polar(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

/// The outside of a wedge: two grids of cells x cells quads that share the `angle` at node 0 and the ray between them.
Mesh outside_of_wedge(double angle, Index cells) {
  const Index row = cells + 1;
  // Row 0 of a grid lies on the ray that it begins with, column 0 on the one that it ends with; there the second
  // begins.
  const auto at = [&](Index side, Index i, Index j) {
    if (side == 0) return i * row + j;
    return i == 0 ? j * row : row * row + (i - 1) * row + j;
  };
  std::vector<Vec2> points(at(1, row, 0));
  Polygons faces;
  for (Index side : {0, 1})
    for (Index i = 0; i < row; ++i)
      for (Index j = 0; j < row; ++j) {
        const auto ray = [&](double share) { return polar(1, 0.5 * (side + share) * angle); };
        const double x = double(j) / cells, y = double(i) / cells;
        const Vec2 far = 1.4 * ray(0.5);
        points[at(side, i, j)] = (x - x * y) * ray(0) + (y - x * y) * ray(1) + x * y * far;
        if (i < cells && j < cells)
          faces.push_back({at(side, i, j), at(side, i, j + 1), at(side, i + 1, j + 1), at(side, i + 1, j)});
      }
  Mesh mesh = drawn(points, faces);
  smoothing::smooth(mesh, {});
  return mesh;
}

double worst_at(const Mesh& mesh, Index v) {
  double worst = 1;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    const auto nodes = topology::nodes_of(mesh, f);
    if (std::find(nodes.begin(), nodes.end(), v) != nodes.end()) worst = std::min(worst, mesh.smallest_sine(f));
  }
  return worst;
}

}  // namespace

TEST_CASE("repair: two changes together raise poor quads that one alone does not, and never lower the worst") {
  std::size_t changes = 0;
  for (int seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    Mesh mesh = spoilt_grid(rng);
    cleanup::repair(mesh, {});
    const Edges boundary = boundary_of(mesh);
    const double worst = topology::smallest_sine(mesh);
    CAPTURE(seed);
    changes += cleanup::repair_in_twos(mesh, {});
    CHECK(topology::smallest_sine(mesh) >= worst);
    CHECK(defect(mesh) == "");
    CHECK(boundary_of(mesh) == boundary);
    CHECK(count_quads(mesh) == count(mesh).faces);
  }
  CHECK(changes > 0);
}

TEST_CASE("repair: a boundary corner whose two quads are closer to straight than to right-angled gets a third quad") {
  Mesh mesh = outside_of_wedge(290 * kDegree, 8);
  REQUIRE(mesh.valence(0) == 3);
  REQUIRE(worst_at(mesh, 0) < 0.6);  // sin 145 degrees
  const Edges boundary = boundary_of(mesh);
  CHECK(cleanup::repair(mesh, {}) > 0);
  CHECK(mesh.valence(0) == 4);
  CHECK(worst_at(mesh, 0) > 0.7);
  CHECK(defect(mesh) == "");
  CHECK(boundary_of(mesh) == boundary);
  CHECK(count_quads(mesh) == count(mesh).faces);
}

TEST_CASE(
    "repair: two quads share a corner of the boundary that leaves them well-shaped, irregular nodes are not made") {
  Mesh mesh = outside_of_wedge(230 * kDegree, 8);
  REQUIRE(mesh.valence(0) == 3);
  CHECK(cleanup::repair(mesh, {}) == 0);
  CHECK(mesh.valence(0) == 3);
}
