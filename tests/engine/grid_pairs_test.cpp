// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid_pairs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "engine/regions.hpp"
#include "qmorph/convert.hpp"
#include "support/domains.hpp"
#include "support/draft.hpp"
#include "support/halves.hpp"
#include "support/invariants.hpp"
#include "support/rng.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

using Quad = std::array<Index, 4>;
using Place = std::function<Eigen::Vector2d(double, double)>;

struct Grid {
  Patch patch;
  std::vector<Quad> cells;
};

/// nx by ny cells with random diagonals, but those that are left out; closed to a ring if asked for.
Grid grid(Index nx, Index ny, const Place& place, std::uint64_t seed,
          const std::function<bool(Index, Index)>& is_out = {}, bool is_ring = false) {
  Rng rng(seed);
  Grid result;
  const Index columns = is_ring ? nx : nx + 1;
  std::vector<Index> number(columns * (ny + 1), kNone);
  const auto node = [&](Index i, Index j) {
    i %= columns;
    Index& known = number[j * columns + i];
    if (known != kNone) return known;
    const Eigen::Vector2d p = place(i, j);
    result.patch.points.emplace_back(p.x(), p.y(), 0);
    return known = Index(result.patch.points.size() - 1);
  };
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      if (is_out && is_out(i, j)) continue;
      result.cells.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
      add_halves(result.patch, result.cells.back(), rng.between(0, 1) < 0.5);
    }
  return result;
}

Place leaning(double degrees, double length = 1) {
  const double slope = std::tan(degrees * std::numbers::pi / 180);
  return [=](double i, double j) { return Eigen::Vector2d(length * i + slope * j, j); };
}

std::set<Quad> by_input(const std::vector<Quad>& quads, const std::vector<Index>& source) {
  std::set<Quad> sorted;
  for (Quad q : quads) {
    if (!source.empty())
      for (Index& v : q) v = source[v];
    std::sort(q.begin(), q.end());
    sorted.insert(q);
  }
  return sorted;
}

/// Checks that the quads are the cells, and how many nodes have moved.
std::size_t check_cells(const Grid& grid) {
  const QuadMesh mesh = convert(grid.patch).mesh;
  const auto broken = broken_invariants(grid.patch, mesh);
  CHECK_MESSAGE(broken.empty(), broken.front());
  CHECK(mesh.triangles.empty());
  CHECK(by_input(mesh.quads, mesh.source) == by_input(grid.cells, {}));
  std::size_t moved = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    moved += mesh.source[v] == kNone || mesh.points[v] != grid.patch.points[mesh.source[v]];
  return moved;
}

}  // namespace

TEST_CASE("grids: one that leans becomes its cells, whichever way they are cut") {
  for (const double degrees : {-45, -30, -10, 10, 20, 30, 40, 45})
    for (const double length : {1.0, 1.5, 2.0}) {
      CAPTURE(degrees);
      CAPTURE(length);
      CHECK(check_cells(grid(11, 8, leaning(degrees, length), std::uint64_t(degrees + 100))) == 0);
    }
}

TEST_CASE("grids: with holes and steps, and once around, they are grids") {
  const auto is_out = [](Index i, Index j) { return (i > 6 && j > 5) || (i > 1 && i < 4 && j > 1 && j < 4); };
  for (const double degrees : {0, 25, 40}) check_cells(grid(11, 9, leaning(degrees), 3, is_out));
  const auto twisted = [](double i, double j) {
    const double angle = 2 * std::numbers::pi * (i + 0.4 * j) / 40, radius = 5 + j;
    return Eigen::Vector2d(radius * std::sin(angle), radius * std::cos(angle));
  };
  check_cells(grid(40, 6, twisted, 4, {}, true));
}

TEST_CASE("grids: nodes that are a little off go where they make better quads") {
  Rng rng(7);
  const auto jittered = [&](double i, double j) {
    const bool is_inside = i > 0 && i < 12 && j > 0 && j < 9;
    return is_inside ? Eigen::Vector2d(i + rng.between(-0.15, 0.15), j + rng.between(-0.15, 0.15))
                     : Eigen::Vector2d(i, j);
  };
  const Grid off = grid(12, 9, jittered, 5);
  CHECK(check_cells(off) > 0);
  const QuadMesh mesh = convert(off.patch).mesh;
  CHECK(smallest_sine(mesh.points, mesh.quads) > 0.99);
}

TEST_CASE("grids: numbers and directions of triangles do not matter") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    const Patch patch = renumbered(grid(9, 7, leaning(rng.between(-45, 45)), seed).patch, rng);
    const Conversion result = convert(patch);
    CAPTURE(seed);
    CHECK(result.mesh.quads.size() == 63);
    CHECK(result.mesh.triangles.empty());
    CHECK(smallest_sine(result.mesh.points, result.mesh.quads) > 0.7);
  }
}

TEST_CASE("grids: other triangles are none, and what is taken for one has four cells at each inner node") {
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Patch patch = random_domain(seed).patch;
    std::vector<Vec2> points;
    for (const auto& p : patch.points) points.emplace_back(p.x(), p.y());
    for (const Region& region : cut_into_regions(patch, points)) {
      const auto cells = pair_as_grid(kernel::Mesh(region.points, region.triangles, region.open));
      if (!cells) continue;
      ++found;
      for (Index f = 0; f < cells->face_slots(); ++f) CHECK((!cells->is_live_face(f) || cells->is_quad(f)));
      for (Index v = 0; v < cells->vertex_slots(); ++v)
        CHECK((!cells->is_live_vertex(v) || cells->is_boundary(v) || cells->valence(v) == 4));
    }
  }
  CHECK(found < 30);
  // A triangle of equilateral ones: rows of an odd number.
  std::vector<Vec2> points;
  std::vector<std::array<Index, 3>> triangles;
  constexpr Index kRows = 8;
  for (Index j = 0, row = 0; j <= kRows; row += kRows + 1 - j, ++j)
    for (Index i = 0; i + j <= kRows; ++i) {
      points.emplace_back(double(i) + 0.5 * double(j), std::sqrt(0.75) * double(j));
      const Index a = row + i, b = a + kRows + 1 - j;
      if (i + j < kRows) triangles.push_back({a, a + 1, b});
      if (i + j + 1 < kRows) triangles.push_back({a + 1, b + 1, b});
    }
  CHECK(!pair_as_grid(kernel::Mesh(points, triangles)));
}
