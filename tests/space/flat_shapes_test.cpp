// SPDX-License-Identifier: GPL-2.0-or-later
// What a move does to the shapes around a node, as its tangent plane shows it.
#include "space/flat_shapes.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "space/grids.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using Eigen::Vector3d;

/// The largest difference between what the plane says about moves of all free nodes, and what is seen in space.
double largest_difference(double height) {
  const GridSurface grid{.across = 8, .along = 8, .jitter = 0.1};
  const Patch patch = triangulated(
      grid, [&](double u, double v) { return Vector3d(u, v, height * std::sin(3 * u) * std::sin(3 * v)); }, 1);
  const auto regions = chart::curved_regions(patch, 3.14);
  REQUIRE(regions.size() == 1);
  std::vector<Index> vertex;
  chart::SurfaceMesh mesh = quads_on(regions[0], quads_of(grid, patch), vertex);
  space::MeshOnSurface view(mesh, {}, *regions[0].background, *regions[0].background);
  const auto sines_around = [&](Index v) {
    double sum = 0;
    view.for_sides_around(v, [&](Index side) { sum += view.exact_sine(side / 4); });
    return sum;
  };
  double most = 0;
  for (Index v = 0; v < view.nodes(); ++v) {
    if (!view.is_free(v)) continue;
    const Vector3d up = view.normal(v), along = Vector3d(up.z(), 0, -up.x()).normalized(), across = up.cross(along);
    space::FlatShapes flat;
    flat.look_around(view, v, along, across);
    const auto before = view.place(v);
    const double sines = sines_around(v);
    for (const Vec2& p : {Vec2(0.01, 0), Vec2(-0.005, 0.01), Vec2(0, -0.012)}) {
      view.move(v, view.foot(v, before.point + p.x() * along + p.y() * across));
      most = std::max(most, std::abs(flat.sines(p) - flat.sines(Vec2::Zero()) - (sines_around(v) - sines)));
      view.move(v, before);
    }
  }
  return most;
}

TEST_CASE("flat shapes: exact in a plane, nearly so where the surface bends") {
  CHECK(largest_difference(0) < 1e-12);
  const double bent = largest_difference(0.05);
  CHECK(bent > 0);
  CHECK(bent < 0.02);
}

}  // namespace
