// SPDX-License-Identifier: GPL-2.0-or-later
// Bands of one row between two boundaries lose their skew.
#include "cleanup/straighten_bands.hpp"

#include <doctest/doctest.h>

#include "kernel/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using cleanup::straighten_bands;

/// One row of quads between straight rails with `edges` edges of length 1; rungs lean by `lean` edges.
Mesh band(Index edges, double lean) {
  Mesh mesh = quad_grid(edges, 1);
  for (Index i = edges + 1; i < mesh.vertex_slots(); ++i) mesh.set_point(i, mesh.point(i) + Vec2(lean, 0));
  return mesh;
}

double mean_sine(const Mesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f)) sum += mesh.smallest_sine(f);
  return sum / count(mesh).faces;
}

}  // namespace

TEST_CASE("bands: rungs that lean by an edge are set upright, and the boundary stays") {
  for (double lean : {1.0, -1.0}) {
    Mesh mesh = band(24, lean);
    const Edges boundary = boundary_of(mesh);
    const double before = mean_sine(mesh), area = area_of(mesh);
    CHECK(straighten_bands(mesh, {}) == 1);
    CHECK(mean_sine(mesh) > before + 0.1);
    CHECK(defect(mesh) == "");
    CHECK(boundary_of(mesh) == boundary);
    CHECK(area_of(mesh) == doctest::Approx(area));
    CHECK(count_quads(mesh) == count(mesh).faces);
  }
}

TEST_CASE("bands: what has been straightened once is left alone") {
  Mesh mesh = band(24, 1);
  REQUIRE(straighten_bands(mesh, {}) == 1);
  const Snapshot once = snapshot(mesh);
  CHECK(straighten_bands(mesh, {}) == 0);
  CHECK(snapshot(mesh) == once);
}

TEST_CASE("bands: upright rungs, and a band of a few quads, stay as they are, to the bit") {
  for (const Mesh& start : {band(24, 0), band(24, 0.3), band(3, 1)}) {
    Mesh mesh = start;
    CHECK(straighten_bands(mesh, {}) == 0);
    CHECK(snapshot(mesh) == snapshot(start));
  }
}

TEST_CASE("bands: two rows have no rung, so they are no band") {
  Mesh mesh = quad_grid(24, 2);
  for (Index v = 0; v < mesh.vertex_slots(); ++v) mesh.set_point(v, mesh.point(v) + Vec2(mesh.point(v).y(), 0));
  const Snapshot before = snapshot(mesh);
  CHECK(straighten_bands(mesh, {}) == 0);
  CHECK(snapshot(mesh) == before);
}

TEST_CASE("bands: a band that is closed to a ring is straightened as well") {
  constexpr Index kEdges = 48;
  std::vector<Vec2> points;
  Polygons faces;
  for (double radius : {10.0, 11.3})
    for (Index i = 0; i < kEdges; ++i) {
      const double angle = 2 * 3.14159265358979 * (i + (radius > 10 ? 1 : 0)) / kEdges;
      points.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
  for (Index i = 0; i < kEdges; ++i) {
    const Index j = (i + 1) % kEdges;
    faces.push_back({i, kEdges + i, kEdges + j, j});
  }
  Mesh mesh = drawn(points, faces);
  const Edges boundary = boundary_of(mesh);
  const double before = mean_sine(mesh);
  CHECK(straighten_bands(mesh, {}) >= 1);
  CHECK(mean_sine(mesh) > before + 0.1);
  CHECK(defect(mesh) == "");
  CHECK(boundary_of(mesh) == boundary);
}
