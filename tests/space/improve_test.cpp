// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes move on a curved surface: shapes get better, nothing leaves the surface, nothing gets worse.
#include "space/improve.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "space/grids.hpp"
#include "space/repair.hpp"
#include "space/smooth.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using chart::CurvedRegion;
using chart::SurfaceMesh;
using Eigen::Vector3d;
using space::MeshOnSurface;

struct Figures {
  double least = 1, mean = 0;
};

Figures figures(MeshOnSurface& mesh) {
  Figures result;
  for (Index f = 0; f < mesh.faces(); ++f) {
    const double sine = mesh.exact_sine(f);
    result.least = std::min(result.least, sine);
    result.mean += sine / mesh.faces();
  }
  return result;
}

double farthest_from(const space::Background& surface, const SurfaceMesh& mesh) {
  double farthest = 0;
  for (Index v = 0; v < mesh.points.size(); ++v)
    farthest = std::max(farthest, std::sqrt(surface.foot_on(mesh.on[v], mesh.points[v]).distance2));
  return farthest;
}

/// A bumpy sheet over the unit square.
Patch bumps(const GridSurface& grid, std::uint64_t seed = 1) {
  return triangulated(
      grid, [](double u, double v) { return Vector3d(u, v, 0.1 * std::sin(5 * u) * std::cos(4 * v)); }, seed);
}

struct Sheet {
  GridSurface grid;
  Patch patch;
  std::vector<CurvedRegion> regions;
  std::vector<Index> vertex;
  SurfaceMesh mesh;

  Sheet(const GridSurface& its_grid, Patch its_patch, double crease_angle = 3.14)
      : grid(its_grid), patch(std::move(its_patch)), regions(chart::curved_regions(patch, crease_angle)) {
    REQUIRE(regions.size() == 1);
    mesh = quads_on(region(), quads_of(grid, patch), vertex);
  }
  const CurvedRegion& region() const { return regions[0]; }
  Index node(Index column, Index row) const { return vertex[row * (grid.across + 1) + column]; }
  MeshOnSurface view() { return {mesh, {}, *region().background, *region().background}; }
};

TEST_CASE("space: smoothing makes quads better, nodes stay on the surface and the boundary where it is") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const GridSurface grid{.across = 14, .along = 11, .jitter = 0.25};
    Sheet sheet(grid, bumps(grid, seed));
    const SurfaceMesh start = sheet.mesh;
    MeshOnSurface view = sheet.view();
    const Figures before = figures(view);
    space::smooth(view, SmoothingOptions());
    const Figures after = figures(view);
    CHECK(after.mean > before.mean + 0.02);
    CHECK(after.least >= std::min(before.least, SmoothingOptions().good_quality) - 1e-3);
    CHECK(farthest_from(*sheet.region().background, sheet.mesh) < 1e-14);
    for (Index j = 0; j <= grid.along; ++j)
      for (Index i = 0; i <= grid.across; ++i)
        if (i == 0 || j == 0 || i == grid.across || j == grid.along)
          CHECK(sheet.mesh.points[sheet.node(i, j)] == start.points[sheet.node(i, j)]);
  }
}

TEST_CASE("space: fixed nodes do not move") {
  const GridSurface grid{.across = 8, .along = 8, .jitter = 0.3};
  Patch patch = bumps(grid);
  patch.fixed = {4 * 9 + 4, 2 * 9 + 6};
  Sheet sheet(grid, patch);
  MeshOnSurface view = sheet.view();
  space::smooth(view, SmoothingOptions());
  space::raise_poor(view, SmoothingOptions());
  for (Index row : patch.fixed) CHECK(sheet.mesh.points[sheet.vertex[row]] == patch.points[row]);
}

TEST_CASE("space: smoothing gives the same bytes each time") {
  const GridSurface grid{.across = 12, .along = 9, .jitter = 0.3};
  Sheet one(grid, bumps(grid)), other(grid, bumps(grid));
  MeshOnSurface view = one.view(), other_view = other.view();
  space::smooth(view, SmoothingOptions());
  space::smooth(other_view, SmoothingOptions());
  for (Index v = 0; v < one.mesh.points.size(); ++v) CHECK(one.mesh.points[v] == other.mesh.points[v]);
}

TEST_CASE("space: elements that are turned over are found, worst first, and turned back") {
  const GridSurface grid{.across = 9, .along = 9};
  for (const double beyond : {0.7, 1.3, 1.8}) {
    Sheet sheet(grid, bumps(grid));
    {
      MeshOnSurface view = sheet.view();
      CHECK(space::find_poor(view, 0).empty());
      const Index v = sheet.node(4, 4);
      const Vector3d diagonal = view.point(sheet.node(5, 5)) - view.point(v);
      view.move(v, view.foot(v, view.point(v) + beyond * diagonal));
      const auto poor = space::find_poor(view, 0);
      REQUIRE_FALSE(poor.empty());
      for (std::size_t i = 0; i + 1 < poor.size(); ++i) CHECK(poor[i].sine <= poor[i + 1].sine);
      CHECK(space::find_turned(sheet.mesh, {}, sheet.region(), {}).size() == poor.size());
    }
    SurfaceMesh mended = sheet.mesh;
    CHECK(space::improve(mended, {}, sheet.region(), {}, SmoothingOptions()).turned.empty());
    CHECK(space::find_turned(mended, {}, sheet.region(), {}).empty());
    SurfaceMesh copy = mended;
    const MeshOnSurface view(copy, {}, *sheet.region().background, *sheet.region().background);
    CHECK(space::find_poor(view, 0.5).empty());
    CHECK(farthest_from(*sheet.region().background, mended) < 1e-14);
  }
}

TEST_CASE("space: a tangle of many nodes is untangled in a chart of its own") {
  const GridSurface grid{.across = 20, .along = 20};
  Sheet sheet(grid, bumps(grid));
  {
    MeshOnSurface view = sheet.view();
    for (Index j = 8; j < 12; ++j)  // four nodes by four are laid over one another, the wrong way round
      for (Index i = 8; i < 12; ++i) {
        const Index v = sheet.node(i, j);
        view.move(
            v, view.foot(v, view.point(sheet.node(10, 10)) - 0.3 * (view.point(v) - view.point(sheet.node(10, 10)))));
      }
    REQUIRE(space::find_poor(view, 0).size() > 4);
  }
  std::size_t work = 0;
  const SurfaceMesh mended =
      space::mend_in_charts(sheet.mesh, {}, sheet.region(), *sheet.region().background, SmoothingOptions(), work);
  SurfaceMesh copy = mended;
  const MeshOnSurface view(copy, {}, *sheet.region().background, *sheet.region().background);
  CHECK(space::find_poor(view, 0).empty());
  CHECK(farthest_from(*sheet.region().background, mended) < 1e-14);
}

TEST_CASE("space: nodes on creases stay, and nodes beside them stay on their side") {
  // A roof: two sheets that meet at 70 degrees along the middle column.
  const GridSurface grid{.across = 10, .along = 10, .jitter = 0};
  Patch patch = triangulated(grid, [](double u, double v) { return Vector3d(u, v, 0.7 * std::min(u, 1 - u)); });
  Rng rng(5);
  Sheet sheet(grid, patch, 0.6);
  REQUIRE(sheet.region().creases.size() >= 9);
  const space::Background parted(sheet.region().points, sheet.region().region.triangles, [&] {
    auto edges = sheet.region().barriers;
    for (const auto& [a, b] : sheet.region().creases) edges.push_back({a, b});
    return edges;
  }());
  {
    MeshOnSurface view(sheet.mesh, sheet.region().creases, parted, *sheet.region().background);
    for (Index j = 1; j < 10; ++j)
      for (Index i = 1; i < 10; ++i) {
        const Index v = sheet.node(i, j);
        CHECK(view.is_free(v) == (i != 5));
        if (i != 5)
          view.move(v, view.foot(v, view.point(v) + 0.03 * Vector3d(rng.between(-1, 1), rng.between(-1, 1), 0)));
      }
  }
  SurfaceMesh result = sheet.mesh;
  CHECK(space::improve(result, sheet.region().creases, sheet.region(), {}, SmoothingOptions()).turned.empty());
  for (Index j = 0; j <= 10; ++j)
    for (Index i = 0; i <= 10; ++i) {
      const Vector3d& p = result.points[sheet.node(i, j)];
      if (i == 5) CHECK(p == sheet.region().points[sheet.node(i, j)]);
      if (i < 5) CHECK(p.x() < 0.5);
      if (i > 5) CHECK(p.x() > 0.5);
    }
  SurfaceMesh copy = result;
  MeshOnSurface view(copy, sheet.region().creases, parted, *sheet.region().background);
  CHECK(figures(view).least > 0.9);
}

}  // namespace
