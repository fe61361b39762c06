// SPDX-License-Identifier: GPL-2.0-or-later
// What is done where no chart is found, and where there are too few nodes.
#include <algorithm>

#include "chart/fixture.hpp"
#include "chart/flatten.hpp"
#include "chart/pair_up.hpp"
#include "chart/refine.hpp"
#include "space/creases.hpp"
#include "support/on_surface.hpp"

using namespace qmorph;
using namespace qmorph::test;
using chart::SurfaceMesh;

namespace {

std::size_t count(const SurfaceMesh& mesh, Index degree) {
  return std::size_t(std::count_if(mesh.faces.begin(), mesh.faces.end(),
                                   [&](const chart::Face& face) { return chart::degree(face) == degree; }));
}

int euler(const SurfaceMesh& mesh) {
  std::vector<std::array<Index, 3>> triangles;
  std::vector<std::array<Index, 4>> quads;
  for (const chart::Face& f : mesh.faces)
    if (chart::degree(f) == 3)
      triangles.push_back({f[0], f[1], f[2]});
    else
      quads.push_back({f[0], f[1], f[2], f[3]});
  return euler_characteristic(triangles, quads);
}

/// Sides that no other face has, and that are no boundary.
std::size_t cracks(const SurfaceMesh& mesh) {
  const std::vector<Index> opposite = chart::opposite_sides(mesh);
  std::size_t result = 0;
  for (Index f = 0; f < mesh.faces.size(); ++f)
    for (Index i = 0; i < chart::degree(mesh.faces[f]); ++i)
      result += opposite[4 * f + i] == kNone && !mesh.open[4 * f + i];
  return result;
}

}  // namespace

TEST_CASE("pair up: closed surfaces become quads without a chart of the whole") {
  Rng rng(31);
  for (const Patch& patch : {sphere(0.15, rng), torus(1, 0.35, 0.15, rng), double_torus(0.15, rng)}) {
    Start start(patch);
    chart::pair_up(start.mesh, {}, *start.region.background, {});
    CHECK(count(start.mesh, 3) == 0);
    CHECK(cracks(start.mesh) == 0);
    CHECK(euler(start.mesh) == euler_characteristic(patch.triangles, {}));
  }
}

TEST_CASE("pair up: of an odd number one triangle is left, and no pair crosses a wall") {
  Rng rng(32);
  for (int k = 0; k < 4; ++k) {
    const Patch patch = pierced(sphere(0.2, rng), {0, 0, 1}, 0.3 + 0.1 * k);
    Start start(patch);
    const std::size_t sides = start.region.region.boundary_sides;
    chart::pair_up(start.mesh, {}, *start.region.background, {});
    CHECK(count(start.mesh, 3) == sides % 2);
    CHECK(cracks(start.mesh) == 0);
  }
  Start start(box({1, 1, 1}, 0.25, rng), 0.7);
  REQUIRE_FALSE(start.region.creases.empty());
  chart::pair_up(start.mesh, start.region.creases, *start.region.background, {});
  const std::vector<bool> on_wall = chart::sides_on(start.mesh, start.region.creases);
  CHECK(std::size_t(std::count(on_wall.begin(), on_wall.end(), true)) == 2 * start.region.creases.size());
}

TEST_CASE("refine: every edge inside has a node in its middle, the boundary and what is kept has none") {
  Rng rng(33);
  for (const Patch& patch :
       {tube(1, 0.3, 0.3, 0, rng), pierced(box({1, 1, 1}, 0.5, rng), {0, 0, 0}, 0.3), box({1, 1, 1}, 1, rng)}) {
    const Start start(patch, 0.7);
    std::size_t inside = 0;
    const std::vector<bool> kept = chart::sides_on(start.mesh, start.region.creases);
    for (Index side = 0; side < start.opposite.size(); ++side)
      inside += start.opposite[side] != kNone && start.opposite[side] < side && !kept[side];
    const SurfaceMesh fine = chart::refined(start.mesh, start.region.creases);
    CHECK(fine.points.size() == start.mesh.points.size() + inside);
    CHECK(cracks(fine) == 0);
    CHECK(euler(fine) == euler(start.mesh));
    const std::vector<bool> still = chart::sides_on(fine, start.region.creases);
    CHECK(std::count(still.begin(), still.end(), true) == std::count(kept.begin(), kept.end(), true));
    CHECK(std::count(fine.open.begin(), fine.open.end(), true) ==
          std::count(start.mesh.open.begin(), start.mesh.open.end(), true));
    for (const chart::Face& f : fine.faces) {
      const Eigen::Vector3d &a = fine.points[f[0]], &b = fine.points[f[1]], &c = fine.points[f[2]];
      CHECK((b - a).cross(c - a).norm() > 1e-6);
    }
  }
}

TEST_CASE("flatten: pieces that do not touch are laid flat one by one") {
  Patch patch = plate(3, 2);
  const Patch other = plate(2, 2);
  for (const Eigen::Vector3d& p : other.points) patch.points.emplace_back(p.x(), 10 - p.z(), p.y());
  for (const auto& t : other.triangles) patch.triangles.push_back({t[0] + 12, t[1] + 12, t[2] + 12});
  const space::Background surface(patch.points, patch.triangles);
  const chart::Flattening flat = chart::flatten(surface, patch.points.size());
  CHECK(flat.flipped == 0);
  CHECK(flat.distortion == doctest::Approx(1).epsilon(1e-6));
}
