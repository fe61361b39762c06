// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes give way so that the centres of quads come nearer to the surface.
#include "space/settle.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "space/grids.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using chart::CurvedRegion;
using chart::SurfaceMesh;
using Eigen::Vector3d;
using space::MeshOnSurface;

/// Quads on the cells of a triangulated surface.
struct Sheet {
  Patch patch;
  std::vector<CurvedRegion> regions;
  std::vector<Index> vertex;
  SurfaceMesh mesh;

  Sheet(const GridSurface& grid, Patch its_patch)
      : patch(std::move(its_patch)), regions(chart::curved_regions(patch, 3.14)) {
    REQUIRE(regions.size() == 1);
    mesh = quads_on(regions[0], quads_of(grid, patch), vertex);
  }
  MeshOnSurface view() { return {mesh, {}, *regions[0].background, *regions[0].background}; }
};

Patch bowl(const GridSurface& grid, double height, std::uint64_t seed) {
  return triangulated(
      grid, [&](double u, double v) { return Vector3d(u, v, height * std::sin(3 * u) * std::sin(3 * v)); }, seed);
}

/// Nodes go a third of an edge aside: as after a conversion, few lie where the surface's triangles meet.
void shift(MeshOnSurface& mesh, double way) {
  for (Index v = 0; v < mesh.nodes(); ++v)
    if (mesh.is_free(v)) mesh.move(v, mesh.foot(v, mesh.point(v) + way * Vector3d(1, 0.5, 0)));
}

double mean_distance_of_centres(const MeshOnSurface& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.faces(); ++f) {
    Vector3d centre = Vector3d::Zero();
    for (Index i = 0; i < 4; ++i) centre += 0.25 * mesh.point(mesh.node(4 * f + i));
    sum += std::sqrt(mesh.surface().walk(centre, mesh.mesh().near[f]).distance2);
  }
  return sum / mesh.faces();
}

TEST_CASE("mesh on a surface: a sine is looked up once, and anew where a node has moved") {
  const GridSurface grid{.across = 6, .along = 6, .jitter = 0.1};
  Sheet sheet(grid, bowl(grid, 0.5, 1));
  MeshOnSurface view = sheet.view();
  const auto sum = [&] {
    double all = 0;
    for (Index f = 0; f < view.faces(); ++f) all += view.exact_sine(f);
    return all;
  };
  const double before = sum();
  CHECK(sum() == before);
  CHECK(view.exact_looks() == view.faces());
  Index v = 0;
  while (!view.is_free(v)) ++v;
  const MeshOnSurface::Place home = view.place(v);
  view.move(v, view.foot(v, home.point + Vector3d(0.05, 0.02, 0)));
  CHECK(sum() != before);
  CHECK(view.exact_looks() == view.faces() + 4);
  view.move(v, home);
  CHECK(sum() == before);
}

TEST_CASE("settle: centres come nearer to the surface, nodes stay on it and good quads stay good") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const GridSurface grid{.across = 12, .along = 12, .jitter = 0.1};
    Sheet sheet(grid, bowl(grid, 0.5, seed));
    MeshOnSurface view = sheet.view();
    shift(view, 0.03);
    const double before = mean_distance_of_centres(view);
    std::vector<double> sines;
    for (Index f = 0; f < view.faces(); ++f) sines.push_back(view.exact_sine(f));
    space::settle(view, SmoothingOptions());
    CHECK(mean_distance_of_centres(view) < 0.9 * before);
    double gain = 0;
    for (Index f = 0; f < view.faces(); ++f) gain += view.exact_sine(f) - sines[f];
    CHECK(gain > 0);
    for (Index f = 0; f < view.faces(); ++f)
      CHECK(view.exact_sine(f) >= std::min(sines[f], SmoothingOptions().good_quality) - 1e-12);
    for (Index v = 0; v < view.nodes(); ++v)
      CHECK(view.surface().foot_on(view.mesh().on[v], view.point(v)).distance2 < 1e-28);
  }
}

TEST_CASE("settle: nothing moves where the surface is flat, and no fixed node anywhere") {
  const GridSurface grid{.across = 9, .along = 9, .jitter = 0.2};
  Sheet flat(grid, bowl(grid, 0, 1));
  const std::vector<Vector3d> start = flat.mesh.points;
  MeshOnSurface view = flat.view();
  space::settle(view, SmoothingOptions());
  for (Index v = 0; v < view.nodes(); ++v) CHECK((view.point(v) - start[v]).norm() < 1e-12);

  Patch patch = bowl(grid, 0.5, 1);
  for (Index row = 0; row < patch.points.size(); row += 3) patch.fixed.push_back(row);
  Sheet held(grid, patch);
  MeshOnSurface other = held.view();
  space::settle(other, SmoothingOptions());
  for (Index row : patch.fixed) CHECK(other.point(held.vertex[row]) == patch.points[row]);
}

}  // namespace
