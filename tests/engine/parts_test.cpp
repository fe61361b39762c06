// SPDX-License-Identifier: GPL-2.0-or-later
// Large regions are cut into parts; what the parts become is put together again.
#include <doctest/doctest.h>

#include "engine/budget.hpp"
#include "engine/parts/convert_parts.hpp"
#include "engine/parts/cutting_line.hpp"
#include "engine/parts/divide.hpp"
#include "engine/parts/grid_outline.hpp"
#include "engine/parts/join.hpp"
#include "kernel/fixture.hpp"
#include "support/domains.hpp"
#include "support/seeds.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

struct Sample {
  Plane plane;
  Region region;
  Mesh mesh;
};

/// Regions of random domains with at least so many triangles, none of them without area.
std::vector<Sample> samples(std::size_t wanted, std::size_t triangles) {
  std::vector<Sample> found;
  for (std::uint64_t seed = 0; found.size() < wanted && seed < 2000; ++seed) {
    const Patch patch = random_domain(seed).patch;
    const Plane plane = *find_plane(patch);
    std::vector<Vec2> points;
    for (const auto& p : patch.points) points.push_back(plane.to_plane(p));
    for (const Region& region : cut_into_regions(patch, points)) {
      Mesh mesh(region.points, region.triangles, region.open);
      for (Index v : region.fixed) mesh.set_fixed(v);
      if (region.triangles.size() < triangles || !find_defects(mesh).empty()) continue;
      found.push_back({plane, region, std::move(mesh)});
    }
  }
  return found;
}

std::vector<Vec2> boundary_points(const Mesh& mesh) {
  std::vector<Vec2> points;
  for (const auto& [a, b] : boundary_of(mesh)) points.push_back(mesh.point(a));
  return points;
}

std::size_t triangles_in(const std::vector<Region>& regions) {
  std::size_t sum = 0;
  for (const Region& region : regions) sum += region.triangles.size();
  return sum;
}

constexpr std::size_t kPart = 80;

}  // namespace

TEST_CASE(
    "parts: a region is cut into valid parts of about the size that is asked for, one odd at most, its boundary "
    "stays") {
  std::size_t large = 0, all = 0;
  for (Sample& sample : samples(60, 4 * kPart)) {
    Mesh& mesh = sample.mesh;
    const Edges boundary = boundary_of(mesh);
    const std::vector<Vec2> points = boundary_points(mesh);
    const Division division = divide(mesh, kPart);
    CHECK(defect(mesh) == "");
    CHECK(boundary_of(mesh) == boundary);
    CHECK(boundary_points(mesh) == points);
    const std::vector<Region> parts = take_apart(mesh, division);
    CHECK(triangles_in(parts) == count(mesh).faces);
    std::size_t odd = 0;
    for (const Region& part : parts) {
      odd += part.boundary_sides % 2;
      large += part.triangles.size() > 2 * kPart, ++all;
      CHECK(defect(Mesh(part.points, part.triangles, part.open)) == "");
    }
    CHECK(odd == sample.region.boundary_sides % 2);
  }
  CHECK(all > 200);
  CHECK(large < all / 50);  // where a cut would leave crumbs
}

TEST_CASE("parts: a region that is not much larger than a part stays whole") {
  for (Sample& sample : samples(5, 100)) {
    const Mesh before = sample.mesh;
    const Division division = divide(sample.mesh, sample.region.triangles.size());
    CHECK(division.parts == 1);
    CHECK(faces_of(sample.mesh) == faces_of(before));
    for (Index v = 0; v < before.vertex_slots(); ++v) CHECK(before.point(v) == sample.mesh.point(v));
  }
}

TEST_CASE("parts: cuts that leave nothing on one side are not made, and no triangle is lost") {
  for (Sample& sample : samples(seeds(30, 6), 40))
    for (std::size_t size : {1, 2, 3}) {
      Mesh mesh = sample.mesh;
      const Division division = divide(mesh, size);
      CHECK(triangles_in(take_apart(mesh, division)) == count(mesh).faces);
    }
}

TEST_CASE("parts: parts that nobody has changed give the same region again when they are joined") {
  for (Sample& sample : samples(30, 4 * kPart)) {
    const Division division = divide(sample.mesh, kPart);
    const std::vector<Region> parts = take_apart(sample.mesh, division);
    std::vector<PartElements> elements;
    for (const Region& part : parts) elements.emplace_back(part.node, Mesh(part.points, part.triangles, part.open));
    const Mesh joined = join(Whole(sample.mesh, division), elements);
    CHECK(defect(joined) == "");
    CHECK(count(joined).faces == count(sample.mesh).faces);
    CHECK(boundary_of(joined) == boundary_of(sample.mesh));
    for (Index v = 0; v < joined.vertex_slots(); ++v) {
      if (!joined.is_live_vertex(v)) continue;
      CHECK(joined.point(v) == sample.mesh.point(v));
      CHECK(joined.is_fixed(v) == sample.mesh.is_fixed(v));
      CHECK(joined.valence(v) == sample.mesh.valence(v));
    }
  }
}

TEST_CASE(
    "parts: nearly all regions can be converted in parts, so that there is no need to start again with the whole") {
  Options options;
  options.part_triangles = kPart;
  std::size_t failed = 0;
  const auto all = samples(seeds(60, 12), 4 * kPart);
  for (const Sample& sample : all) {
    ConversionReport report;
    Record record;
    const double allowed = allowance(sample.region.triangles.size());
    const auto mesh = convert_in_parts(sample.mesh, {}, sample.plane, options, allowed, report, record);
    REQUIRE(mesh);
    CHECK(find_defects(*mesh, false).empty());
    failed += find_fault(*mesh, sample.region, sample.plane).has_value();
  }
  CHECK(failed <= 1);
}

TEST_CASE(
    "parts: an outline that a grid fits into is one with four corners and equal opposite sides, and nothing inside") {
  CHECK(has_grid_outline(grid(12, 8, Diagonals::rising)));
  Rng rng(1);
  const auto with_hole = [](Index x, Index y) { return x == 5 && y == 4; };
  CHECK_FALSE(has_grid_outline(grid(12, 8, Diagonals::rising, rng, with_hole)));
  const auto with_notch = [](Index x, Index y) { return x > 5 && y > 4; };
  CHECK_FALSE(has_grid_outline(grid(12, 8, Diagonals::rising, rng, with_notch)));

  Mesh uneven = grid(12, 8, Diagonals::rising);
  Index h = 0;
  while (uneven.face(h) != kNone) ++h;
  uneven.split_edge(h, 0.5 * (uneven.point(uneven.origin(h)) + uneven.point(uneven.target(h))));
  CHECK_FALSE(has_grid_outline(uneven));

  Mesh with_point = grid(12, 8, Diagonals::rising);
  Index v = 0;
  while (with_point.is_boundary(v)) ++v;
  with_point.set_fixed(v);
  CHECK_FALSE(has_grid_outline(with_point));
}

TEST_CASE("parts: a long rectangle is cut across, and a notch attracts the cut") {
  const auto outline = [](const std::vector<Vec2>& corners) {
    std::vector<std::pair<Vec2, Vec2>> segments;
    for (std::size_t i = 0; i < corners.size(); ++i)
      segments.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
    return segments;
  };
  std::vector<Vec2> points;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 10; ++j) points.emplace_back(0.1 * i + 0.05, 0.1 * j + 0.05);
  const Line across = choose_cutting_line(points, outline({{0, 0}, {4, 0}, {4, 1}, {0, 1}}), 0.5);
  CHECK(std::abs(across.normal.x()) == doctest::Approx(1));
  CHECK(across.offset == doctest::Approx(2).epsilon(0.2));
  const auto notched = outline({{0, 0}, {1.6, 0}, {1.6, 0.6}, {1.7, 0.6}, {1.7, 0}, {4, 0}, {4, 1}, {0, 1}});
  const Line at_notch = choose_cutting_line(points, notched, 0.5);
  CHECK(std::abs(at_notch.normal.x()) == doctest::Approx(1));
  CHECK(at_notch.offset > 1.6);
  CHECK(at_notch.offset < 1.7);
}
