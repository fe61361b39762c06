// SPDX-License-Identifier: GPL-2.0-or-later
// The form of a patch that does not depend on who numbered and placed it.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "engine/canonical/frame.hpp"
#include "engine/canonical/numbered.hpp"
#include "engine/canonical/rounded.hpp"
#include "qmorph/convert.hpp"
#include "support/domains.hpp"
#include "support/seeds.hpp"
#include "support/surfaces.hpp"
#include "support/symmetries.hpp"
#include "support/watcher.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using canonical::Numbered;

Eigen::Matrix3d right_angle(int axis) {
  return Eigen::Matrix3d(
      Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::Unit(axis)).toRotationMatrix().array().round());
}

Patch turned(const Patch& patch, const Eigen::Matrix3d& turn) { return moved(patch, 1, turn, Eigen::Vector3d::Zero()); }

bool is_same(const Patch& a, const Patch& b) {
  return a.points == b.points && a.triangles == b.triangles && a.quads == b.quads && a.constraints == b.constraints &&
         a.fixed == b.fixed;
}

QuadMesh as_mesh(const Patch& patch) {
  QuadMesh mesh{patch.points, std::vector<Index>(patch.points.size()), patch.triangles, patch.quads};
  std::iota(mesh.source.begin(), mesh.source.end(), 0);
  return mesh;
}

/// Two squares of two triangles each, side by side with a slit between them but for one end.
Patch slit() {
  Patch patch;
  for (const auto& [x, y] :
       {std::pair(0.0, 0.0), {1.0, 0.0}, {2.5, 0.0}, {2.5, 1.0}, {1.0, 1.0}, {1.0, 1.0}, {0.0, 1.5}})
    patch.points.emplace_back(x, y, 0);
  patch.triangles = {{0, 1, 5}, {0, 5, 6}, {1, 2, 3}, {1, 3, 4}};
  return patch;
}

}  // namespace

TEST_CASE(
    "canonical: the same bytes for a surface that is turned by right angles, mirrored, turned over and renumbered") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Patch patch = seed % 3 == 0 ? random_surface(seed).patch : random_domain(seed).patch;
    if (is_symmetric(patch)) continue;
    const Patch own = canonical::numbered(patch)->patch;
    Rng rng(seed);
    const Eigen::Matrix3d mirror = Eigen::Vector3d(-1, 1, 1).asDiagonal();
    CAPTURE(seed);
    CHECK(is_same(canonical::numbered(renumbered(patch, rng))->patch, own));
    CHECK(is_same(canonical::numbered(turned_over(patch))->patch, own));
    for (const Eigen::Matrix3d& turn : {right_angle(0), right_angle(1), right_angle(2), mirror})
      CHECK(is_same(canonical::numbered(renumbered(turned(patch, turn), rng))->patch, own));
  }
}

TEST_CASE("canonical: nodes at one place are told apart by their triangles") {
  const Patch own = canonical::numbered(slit())->patch;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    CHECK(is_same(canonical::numbered(renumbered(turned(slit(), right_angle(2)), rng))->patch, own));
  }
}

TEST_CASE("canonical: a surface that is symmetric but for rounding has a frame all the same") {
  Patch patch;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) patch.points.emplace_back(0.1 * i, 0.1 * j, 0);
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) patch.quads.push_back({4 * i + j, 4 * i + j + 4, 4 * i + j + 5, 4 * i + j + 1});
  const Patch own = canonical::numbered(patch)->patch;
  CHECK(is_same(canonical::numbered(turned(patch, right_angle(2)))->patch, own));
}

TEST_CASE("canonical: a surface comes back from its frame as it was") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Patch patch = seed % 3 == 0 ? random_surface(seed).patch : random_domain(seed).patch;
    const Numbered own = *canonical::numbered(patch);
    const QuadMesh back = canonical::in_callers_terms(as_mesh(own.patch), patch, own);
    CAPTURE(seed);
    CHECK(back.points == patch.points);
    CHECK(back.quads == patch.quads);
    REQUIRE(back.triangles.size() == patch.triangles.size());
    const auto from_smallest = [](std::vector<std::array<Index, 3>> all) {
      for (auto& t : all) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      std::sort(all.begin(), all.end());
      return all;
    };
    CHECK(from_smallest(back.triangles) == from_smallest(patch.triangles));
  }
}

TEST_CASE("canonical: patches without elements are left alone") { CHECK_FALSE(canonical::numbered(Patch{})); }

TEST_CASE("canonical: observers are told of fronts where they are in the model, seen from the elements' side") {
  for (std::uint64_t seed = 0; seed < seeds(12, 3); ++seed)
    for (const bool is_mirrored : {false, true}) {
      const Eigen::Matrix3d turn =
          is_mirrored ? Eigen::Matrix3d(Eigen::Vector3d(1, -1, 1).asDiagonal()) : right_angle(0);
      const Patch patch = turned(random_domain(seed).patch, turn);
      Watcher watcher;
      Options options;
      options.observer = &watcher;
      convert(patch, options);
      CAPTURE(seed);
      CAPTURE(is_mirrored);
      for (const auto& note : watcher.fronts) {
        const FrontPlayer& player = note.player();
        const Eigen::Vector3d normal = player.frame.axis_u.cross(player.frame.axis_v);
        CHECK((normal - watcher.stages.front().normal).norm() < 1e-9);
        const auto place = [&](Index v) -> Eigen::Vector3d {
          return player.frame.origin + player.points[v].x() * player.frame.axis_u +
                 player.points[v].y() * player.frame.axis_v;
        };
        // The front's quads are those of the stage after it, or of a part of it: each is where there is one.
        const QuadMesh& after = watcher.stages[std::size_t(Stage::input)].mesh;
        double size = 0;
        for (const auto& p : after.points) size = std::max(size, (p - after.points[0]).norm());
        for (const auto& face : player.faces) {
          if (face[0] == kNone || face[3] != kNone) continue;  // triangles that are left
          const Eigen::Vector3d a = place(face[0]), area = (place(face[1]) - a).cross(place(face[2]) - a);
          CHECK(area.dot(normal) > 0);
          const Eigen::Vector3d offset = a - after.points[0];
          CHECK(std::abs(offset.dot(normal)) < 1e-6 * size);
        }
      }
    }
}

TEST_CASE("canonical: coordinates are rounded from the corner of the box, and come back") {
  Region region;
  region.points = {{0.1, 0.2}, {1.3, 0.1}, {0.7, 1.9}};
  region.node = {0, 1, 2};
  region.triangles = {{0, 1, 2}};
  region.open = {true, true, true};
  Plane plane;
  Region here = region, there = region;
  for (Vec2& p : there.points) p += Vec2(1000, -77);
  const auto rounding = canonical::round_points(here, plane);
  REQUIRE(rounding);
  CHECK(rounding->exact == region.points);
  REQUIRE(canonical::round_points(there, plane));
  CHECK(there.points == here.points);
  kernel::Mesh mesh(here.points, here.triangles, here.open);
  canonical::put_back(mesh, *rounding, here);
  for (Index v = 0; v < 3; ++v) CHECK(mesh.point(v) == region.points[v]);
  region.points[2] = {0.7, 0.15 + 1e-6};
  const std::vector<Vec2> as_they_were = region.points;
  CHECK_FALSE(canonical::round_points(region, plane));
  CHECK(region.points == as_they_were);
}
