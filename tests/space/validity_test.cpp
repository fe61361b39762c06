// SPDX-License-Identifier: GPL-2.0-or-later
// Elements in space: what is good on curved walls stays good, what is turned over is found.
#include <doctest/doctest.h>

#include <cmath>

#include "qmorph/quality.hpp"
#include "quality/shapes.hpp"
#include "space/grids.hpp"
#include "space/mesh_normals.hpp"
#include "space/reference.hpp"
#include "space/surface_normals.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;

struct Case {
  GridSurface grid;
  Patch patch;
  QuadMesh mesh;
};

Case cylinder_of_quads(Index across, double jitter = 0) {
  Case result{{.across = across, .along = 6, .jitter = jitter}, {}, {}};
  result.patch = cylinder(result.grid);
  result.grid.closed_across = true;
  result.mesh = quads_of(result.grid, result.patch);
  return result;
}

Quality alone(const QuadMesh& mesh) { return measure(mesh); }
Quality on_input(const Case& c) {
  QualityAccumulator quality;
  quality.add(c.patch, c.mesh);
  return quality.result();
}

TEST_CASE("in space: quads around a closed wall are good, however coarse it is") {
  for (const Index across : {3u, 4u, 8u, 30u}) {
    const Case c = cylinder_of_quads(across);
    for (const Quality& q : {alone(c.mesh), on_input(c)}) {
      CHECK(q.inverted == 0);
      CHECK(q.scaled_jacobian_min == doctest::Approx(1));
      CHECK(q.angle_min_deg == doctest::Approx(90));
      CHECK(q.angle_max_deg == doctest::Approx(90));
    }
  }
}

TEST_CASE("in space: a closed torus has good quads, and none when it is judged from the other side") {
  Case c{{.across = 24, .along = 10, .jitter = 0.1}, {}, {}};
  c.patch = torus(c.grid);
  c.grid.closed_across = c.grid.closed_along = true;
  c.mesh = quads_of(c.grid, c.patch);
  CHECK(on_input(c).inverted == 0);
  CHECK(alone(c.mesh).inverted == 0);
  c.mesh.source.clear();  // nothing is known of its nodes: it is found all the same
  CHECK(on_input(c).inverted == 0);
  for (auto& quad : c.mesh.quads) std::swap(quad[1], quad[3]);
  CHECK(on_input(c).inverted == c.mesh.quads.size());
  CHECK(alone(c.mesh).inverted == 0);
}

TEST_CASE("in space: elements that are turned over or not convex are found, by the input and by their neighbours") {
  const Case good = cylinder_of_quads(16, 0.1);
  const Index node = 3 * 16 + 5;  // inside
  const Vector3d start = good.mesh.points[node], beside = good.mesh.points[node + 1],
                 above = good.mesh.points[node + 16];
  SUBCASE("a node far beyond its neighbour") {
    Case c = good;
    c.mesh.points[node] = start + 1.6 * (beside - start);
    CHECK(on_input(c).inverted >= 2);
    CHECK(alone(c.mesh).inverted >= 2);
    CHECK(on_input(c).scaled_jacobian_min < -0.1);
    CHECK(on_input(c).angle_max_deg > 180);
  }
  SUBCASE("a chevron: the node moves over the diagonal of one of its quads") {
    Case c = good;
    c.mesh.points[node] = start + 0.65 * (beside - start) + 0.65 * (above - start);
    CHECK(on_input(c).inverted == 1);
    CHECK(alone(c.mesh).inverted == 1);
  }
  SUBCASE("a quad inside out, among others") {
    Case c = good;
    auto& quad = c.mesh.quads[2 * 16 + 4];
    const Vector3d a = c.mesh.points[quad[0]], d = c.mesh.points[quad[2]];
    c.mesh.points[quad[0]] = a + 1.2 * (d - a);
    c.mesh.points[quad[2]] = d + 1.2 * (a - d);
    CHECK(on_input(c).inverted >= 1);
    CHECK(alone(c.mesh).inverted >= 1);
  }
}

TEST_CASE("in space: a quad over a sharp fillet is good by the mean normal") {
  // The surface turns by a right angle along two narrow strips of triangles; one quad lies over them.
  Patch patch;
  patch.points = {{0, 0, 0}, {1, 0, 0}, {1.1, 0, 0.1}, {1.1, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1.1, 1, 0.1}, {1.1, 1, 1}};
  for (const Index i : {0u, 1u, 2u}) {
    patch.triangles.push_back({i, i + 1, i + 5});
    patch.triangles.push_back({i, i + 5, i + 4});
  }
  const space::Background surface(patch.points, patch.triangles);
  const space::Corners<4> quad{patch.points[0], patch.points[3], patch.points[7], patch.points[4]};
  const space::SurfaceNormals normals(surface);
  const space::Corners<4> over{quad[3], quad[2], quad[1], quad[0]};
  CHECK(space::scaled_jacobian(quad, normals.of(quad, 0)) == doctest::Approx(1));
  CHECK(space::scaled_jacobian(over, normals.of(over, 0)) == doctest::Approx(-1));
}

TEST_CASE("in space: along a barrier elements are judged by their own side of it") {
  // Two squares that meet at 30 degrees, nearly folded; each a quad.
  Patch patch;
  patch.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0.5}, {0, 1, 0.5}};
  patch.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  patch.constraints = {{1, 2}};
  QuadMesh mesh;
  mesh.points = patch.points;
  mesh.source = {0, 1, 2, 3, 4, 5};
  mesh.quads = {{0, 1, 2, 3}, {1, 4, 5, 2}};
  CHECK(on_input({{}, patch, mesh}).inverted == 0);
  std::swap(mesh.quads[1][1], mesh.quads[1][3]);
  CHECK(on_input({{}, patch, mesh}).inverted == 1);
}

TEST_CASE("in space: each element finds the triangle under its centre, on its side of the barriers") {
  const Case c = cylinder_of_quads(20, 0.2);
  const space::Reference reference(c.patch);
  const space::ElementSides sides(c.mesh.points.size(), c.mesh.triangles, c.mesh.quads);
  for (const bool with_source : {true, false}) {
    const std::vector<Index> source = with_source ? c.mesh.source : std::vector<Index>{};
    const auto found = space::locate({reference.surface, c.mesh.points, c.mesh.triangles, c.mesh.quads, source}, sides,
                                     space::SurfaceNormals(reference.surface));
    for (Index q = 0; q < c.mesh.quads.size(); ++q) CHECK(found[q] / 2 == q);  // triangles lie two by two in the cells
  }
}

TEST_CASE("in space: a point on one side of a thin sheet is not looked for on the other, wherever the search starts") {
  // Two strips of squares a tenth apart, joined at one end by a rim.
  constexpr Index kSquares = 6;
  std::vector<Vector3d> points;
  std::vector<space::Background::Triangle> triangles;
  const auto add_row = [&](double x, double z) { points.insert(points.end(), {Vector3d(x, 0, z), Vector3d(x, 1, z)}); };
  for (Index i = 0; i <= kSquares; ++i) add_row(double(i), 0);
  for (Index i = kSquares + 1; i-- > 0;) add_row(double(i), 0.1);
  for (Index a = 0; a + 2 < points.size(); a += 2) {
    triangles.push_back({a, a + 2, a + 3});
    triangles.push_back({a, a + 3, a + 1});
  }
  const space::Background surface(points, triangles);
  const space::SurfaceNormals normals(surface);
  for (Index t = 0; t < triangles.size(); ++t) {
    const Vector3d centre = (surface.corner(t, 0) + surface.corner(t, 1) + surface.corner(t, 2)) / 3;
    for (Index hint = 0; hint < triangles.size(); ++hint) CHECK(normals.closest(centre, hint).triangle == t);
  }
}

TEST_CASE("in space: quads of a mixed surface are part of the reference, cut where they are less bent") {
  Patch patch;
  patch.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  patch.triangles = {{1, 4, 5}, {1, 5, 2}};
  patch.quads = {{0, 1, 2, 3}};
  const space::Reference reference(patch);
  CHECK(reference.surface.triangles() == 4);
  CHECK(reference.surface.walk({0.2, 0.4, 1}, 0).triangle >= 2);
  CHECK(reference.surface.neighbour(1, 2) >= 2);
}

TEST_CASE("in space: corners with NaN or with sides without length are not good") {
  space::CornerNormals<4> normals;
  normals.at.fill(Vector3d::UnitZ());
  normals.whole = Vector3d::UnitZ();
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
  CHECK(space::scaled_jacobian<4>({a, b, c, d}, normals) == 1);
  CHECK(space::scaled_jacobian<4>({a, a, c, d}, normals) == 0);
  CHECK(space::scaled_jacobian<4>({a, b, c, {0, std::nan(""), 0}}, normals) == -1);
}

}  // namespace
