// SPDX-License-Identifier: GPL-2.0-or-later
#include "qmorph/certificate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"

namespace {

using namespace qmorph;
using Eigen::Vector3d;

std::vector<PoorQuad> explain(const Patch& before, const QuadMesh& after) {
  QualityAccumulator quality;
  quality.add(before, after);
  return explain_poor_quads(before, after, quality.scaled_jacobians());
}

/// A grid of quads in the plane, and the triangles that it came from. Cell (i, j) is quad 10 j + i.
struct Grid {
  Patch patch;
  QuadMesh mesh;
  Grid() {
    for (int j = 0; j <= 10; ++j)
      for (int i = 0; i <= 10; ++i) patch.points.emplace_back(i, j, 0);
    for (Index j = 0; j < 10; ++j)
      for (Index i = 0; i < 10; ++i) {
        const Index a = 11 * j + i;
        patch.triangles.push_back({a, a + 1, a + 12});
        patch.triangles.push_back({a, a + 12, a + 11});
        mesh.quads.push_back({a, a + 1, a + 12, a + 11});
      }
    mesh.points = patch.points;
    for (Index i = 0; i < mesh.points.size(); ++i) mesh.source.push_back(i);
  }
};

TEST_CASE("certificate: good quads need none") {
  const Grid grid;
  CHECK(explain(grid.patch, grid.mesh).empty());
}

TEST_CASE("certificate: a poor quad far from any constraint is our fault, and has a place and a figure") {
  Grid grid;
  grid.mesh.points[11 * 5 + 5] = Vector3d(5.93, 5.93, 0);  // nearly on the diagonal of a quad
  const auto poor = explain(grid.patch, grid.mesh);
  REQUIRE_FALSE(poor.empty());
  for (const PoorQuad& quad : poor) {
    CHECK(quad.reason == PoorBecause::nothing);
    CHECK(quad.scaled_jacobian < 0.3);
  }
}

TEST_CASE("certificate: a corner of the boundary that is too sharp, and only one that is") {
  for (const double degrees : {10.0, 17.0, 19.0, 30.0}) {
    const double half = degrees * std::numbers::pi / 360, x = std::cos(half), y = std::sin(half);
    QuadMesh mesh;
    mesh.points = {{0, 0, 0}, {x, -y, 0}, {1 / x, 0, 0}, {x, y, 0}};  // a kite with right angles beside the sharp one
    mesh.quads = {{0, 1, 2, 3}};
    mesh.source = {0, 1, 2, 3};
    Patch patch;
    patch.points = mesh.points;
    patch.triangles = {{0, 1, 2}, {0, 2, 3}};
    const auto poor = explain(patch, mesh);
    CHECK(poor.size() == (degrees < 17.4 ? 1 : 0));
    for (const PoorQuad& quad : poor) CHECK(quad.reason == PoorBecause::boundary_angle);
  }
}

TEST_CASE("certificate: a sharp corner is one though it is parted between two quads") {
  const double degrees = 10, half = degrees * std::numbers::pi / 360, x = std::cos(half), y = std::sin(half);
  QuadMesh mesh;
  mesh.points = {{0, 0, 0}, {x, -y, 0}, {1.5, -0.1, 0}, {1, 0, 0}, {1.5, 0.1, 0}, {x, y, 0}};
  mesh.quads = {{0, 1, 2, 3}, {0, 3, 4, 5}};
  mesh.source = {0, 1, 2, 3, 4, 5};
  Patch patch;
  patch.points = mesh.points;
  patch.triangles = {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}};
  const auto poor = explain(patch, mesh);
  CHECK(poor.size() == 2);
  for (const PoorQuad& quad : poor) CHECK(quad.reason == PoorBecause::boundary_angle);
}

TEST_CASE("certificate: a crease is an edge that is kept") {
  // Two flat kites of 10 degrees, folded by a right angle along an edge that ends in both their tips.
  const double half = 5 * std::numbers::pi / 180, x = std::cos(half), y = std::sin(half);
  const Vector3d along(x, y, 0), across(0, 0, 1);
  const auto folded = [&](const Vector3d& p) -> Vector3d {  // mirrored at the fold, and turned up around it
    const Vector3d foot = p.dot(along) * along;
    return foot + (p - foot).norm() * across;
  };
  Patch patch;
  patch.points = {{0, 0, 0}, {x, -y, 0}, {1 / x, 0, 0}, {x, y, 0}};
  patch.points.push_back(folded(patch.points[2])), patch.points.push_back(folded(patch.points[1]));
  patch.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  QuadMesh mesh;
  mesh.points = patch.points;
  mesh.source = {0, 1, 2, 3, 4, 5};
  mesh.quads = {{0, 1, 2, 3}, {0, 3, 4, 5}};
  const std::vector<double> figures(2, y);
  const auto with_crease = explain_poor_quads(patch, mesh, figures);
  REQUIRE(with_crease.size() == 2);
  for (const PoorQuad& quad : with_crease) CHECK(quad.reason == PoorBecause::boundary_angle);
  for (const PoorQuad& quad : explain_poor_quads(patch, mesh, figures, std::numbers::pi))
    CHECK(quad.reason != PoorBecause::boundary_angle);
}

TEST_CASE("certificate: a quad between four kept edges, even where no corner is too sharp") {
  Patch patch;
  patch.points = {{0, 0, 0}, {1, -0.9, 0}, {2, 0, 0}, {1, 0.05, 0}};  // nearly straight at the last one
  patch.triangles = {{0, 1, 3}, {1, 2, 3}};
  QuadMesh mesh;
  mesh.points = patch.points;
  mesh.source = {0, 1, 2, 3};
  mesh.quads = {{0, 1, 2, 3}};
  const auto poor = explain(patch, mesh);
  REQUIRE(poor.size() == 1);
  CHECK(poor[0].reason == PoorBecause::boundary_angle);
}

TEST_CASE("certificate: a narrow strip whose nodes do not face each other") {
  // Two rows of nodes 0.1 apart, the upper ones half a step on: every quad leans.
  QuadMesh mesh;
  for (int i = 0; i <= 6; ++i) mesh.points.emplace_back(i, 0, 0);
  for (int i = 0; i <= 6; ++i) mesh.points.emplace_back(i + 0.5, 0.1, 0);
  for (Index i = 0; i < 6; ++i) mesh.quads.push_back({i, i + 1, i + 8, i + 7});
  for (Index i = 0; i < mesh.points.size(); ++i) mesh.source.push_back(i);
  Patch patch;
  patch.points = mesh.points;
  for (const auto& [a, b, c, d] : mesh.quads)
    patch.triangles.push_back({a, b, c}), patch.triangles.push_back({a, c, d});
  const auto poor = explain(patch, mesh);
  CHECK(poor.size() == 6);
  std::size_t narrow = 0;
  for (const PoorQuad& quad : poor) narrow += quad.reason == PoorBecause::narrow;
  CHECK(narrow >= 4);  // the ends are sharp corners
  for (const PoorQuad& quad : poor) CHECK(quad.reason != PoorBecause::nothing);
}

TEST_CASE("certificate: a narrow strip whose nodes face each other forces nothing") {
  // A ladder, 0.1 wide, but that its quads have been cut askew: from node i below to node i + 1 above.
  QuadMesh mesh;
  for (const double y : {0.0, 0.1})
    for (int i = 0; i <= 6; ++i) mesh.points.emplace_back(i, y, 0);
  for (Index i = 0; i < 5; ++i) mesh.quads.push_back({i, i + 1, i + 9, i + 8});
  mesh.triangles = {{0, 8, 7}, {5, 6, 13}};
  for (Index i = 0; i < mesh.points.size(); ++i) mesh.source.push_back(i);
  Patch patch;
  patch.points = mesh.points;
  for (Index i = 0; i < 6; ++i) patch.triangles.insert(patch.triangles.end(), {{i, i + 1, i + 8}, {i, i + 8, i + 7}});
  for (const PoorQuad& quad : explain(patch, mesh)) {
    CAPTURE(quad.quad);
    const bool is_at_end = quad.quad == 0 || quad.quad == 4;
    CHECK(quad.reason == (is_at_end ? PoorBecause::odd_region : PoorBecause::nothing));
  }
}

TEST_CASE("certificate: beside a long kept edge the second row of elements is in its way, too") {
  // A lens over one edge of length 10; its other side has ten edges. Two rows of elements between them.
  QuadMesh mesh;
  const auto height = [](int i) { return 0.1 * i * (10 - i) / 2.5; };
  for (int i = 0; i <= 10; ++i) mesh.points.emplace_back(i, height(i), 0);
  for (int i = 2; i <= 8; ++i) mesh.points.emplace_back(i, height(i) / 2, 0);  // rows 11 to 17
  for (Index i = 2; i < 8; ++i) mesh.quads.push_back({9 + i, 10 + i, i + 1, i});
  mesh.quads.push_back({0, 11, 2, 1});
  mesh.quads.push_back({17, 10, 9, 8});
  for (Index i = 11; i < 17; ++i) mesh.triangles.push_back({0, i + 1, i});
  mesh.triangles.push_back({0, 10, 17});
  for (Index i = 0; i < mesh.points.size(); ++i) mesh.source.push_back(i <= 10 ? i : kNone);
  Patch patch;
  patch.points.assign(mesh.points.begin(), mesh.points.begin() + 11);
  for (Index i = 1; i < 10; ++i) patch.triangles.push_back({0, i + 1, i});
  std::vector<double> figures(mesh.quads.size(), 1);
  figures[3] = 0.2;  // as if it were poor: in the middle
  const auto poor = explain_poor_quads(patch, mesh, figures);
  REQUIRE(poor.size() == 1);
  CHECK(poor[0].reason == PoorBecause::narrow);
}

TEST_CASE("certificate: lines that are kept count as boundaries") {
  Grid grid;
  for (Index i = 0; i < 10; ++i) grid.patch.constraints.push_back({11 * 5 + i, 11 * 5 + i + 1});
  for (int i = 0; i <= 10; ++i) {  // the row above comes near to the line, and half a step aside
    grid.patch.points[11 * 6 + i] = Vector3d(i + 0.4, 5.1, 0);
    grid.mesh.points[11 * 6 + i] = grid.patch.points[11 * 6 + i];
  }
  for (Index i = 0; i < 10; ++i) grid.patch.constraints.push_back({11 * 6 + i, 11 * 6 + i + 1});
  const auto poor = explain(grid.patch, grid.mesh);
  CHECK(poor.size() == 10);
  for (const PoorQuad& quad : poor) CHECK(quad.reason != PoorBecause::nothing);
  grid.patch.constraints.clear();
  bool any_ours = false;
  for (const PoorQuad& quad : explain(grid.patch, grid.mesh))
    any_ours = any_ours || quad.reason == PoorBecause::nothing;
  CHECK(any_ours);
}

TEST_CASE("certificate: beside the triangle of an odd region") {
  Grid grid;
  grid.mesh.quads[44] = {kNone, kNone, kNone, kNone};
  std::erase_if(grid.mesh.quads, [](const auto& q) { return q[0] == kNone; });
  const Index a = 11 * 4 + 4;
  grid.mesh.triangles = {{a, a + 1, a + 12}, {a, a + 12, a + 11}};
  grid.mesh.points[a] = Vector3d(4.93, 4.93, 0);
  const auto poor = explain(grid.patch, grid.mesh);
  REQUIRE_FALSE(poor.empty());
  for (const PoorQuad& quad : poor) CHECK(quad.reason == PoorBecause::odd_region);
}

TEST_CASE("certificate: quads of the input are the input's responsibility") {
  Grid grid;
  grid.mesh.points[11 * 5 + 5] = grid.patch.points[11 * 5 + 5] = Vector3d(5.93, 5.93, 0);
  grid.patch.quads = grid.mesh.quads;
  grid.patch.triangles.clear();
  const auto poor = explain(grid.patch, grid.mesh);
  REQUIRE_FALSE(poor.empty());
  for (const PoorQuad& quad : poor) CHECK(quad.reason == PoorBecause::kept);
}

TEST_CASE("certificate: a surface that is folded within the quad") {
  // A sheet of five rows that turns back over itself and on again; a quad in the middle row lies over the folds.
  Patch patch;
  QuadMesh mesh;
  const std::vector<Vector3d> profile{{-2, 0, 0},    {-1, 0, 0},    {0, 0, 0},     {1, 0, 0},    {0.3, 0, 0.1},
                                      {1.3, 0, 0.2}, {2.3, 0, 0.2}, {3.3, 0, 0.2}, {4.3, 0, 0.2}};
  const Index columns = Index(profile.size());
  for (int row = 0; row <= 5; ++row)
    for (const Vector3d& p : profile) patch.points.emplace_back(p.x(), row, p.z());
  for (Index row = 0; row < 5; ++row)
    for (Index i = 0; i + 1 < columns; ++i) {
      const Index a = row * columns + i;
      patch.triangles.push_back({a, a + 1, a + columns + 1});
      patch.triangles.push_back({a, a + columns + 1, a + columns});
      mesh.quads.push_back({a, a + 1, a + columns + 1, a + columns});
    }
  mesh.points = patch.points;
  for (Index i = 0; i < mesh.points.size(); ++i) mesh.source.push_back(i);
  std::vector<double> figures(mesh.quads.size(), 1);
  const Index over_folds = 2 * (columns - 1) + 3;
  figures[over_folds] = 0.1;  // as if it were poor
  const auto poor = explain_poor_quads(patch, mesh, figures);
  REQUIRE(poor.size() == 1);
  CHECK(poor[0].quad == over_folds);
  CHECK(poor[0].reason == PoorBecause::input_geometry);
}

TEST_CASE("certificate: every reason has a name of its own") {
  for (std::size_t i = 0; i < kPoorReasons; ++i)
    for (std::size_t j = 0; j < i; ++j) CHECK(name_of(PoorBecause(i)) != name_of(PoorBecause(j)));
}

}  // namespace
