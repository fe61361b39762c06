// SPDX-License-Identifier: GPL-2.0-or-later
// What always works: two triangles meet, whatever lies between them.
#include "elimination/certain.hpp"

#include <doctest/doctest.h>

#include "kernel/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using elimination::pair_along;

/// Two triangles a r t and r b t, both counter-clockwise: their union has any shape that two triangles can have.
std::vector<Vec2> random_pair(Rng& rng) {
  const double flat = rng.power_of_two(-12, 0);
  while (true) {
    std::vector<Vec2> p;
    for (int i = 0; i < 4; ++i) p.emplace_back(rng.between(-1, 1), flat * rng.between(-1, 1));
    if (corner_sine(p[0], p[1], p[3]) > 1e-3 && corner_sine(p[1], p[2], p[3]) > 1e-3 &&
        corner_sine(p[3], p[0], p[1]) > 1e-3 && corner_sine(p[3], p[1], p[2]) > 1e-3)
      return p;
  }
}

void check_pair(const std::vector<Vec2>& points) {
  Mesh mesh = drawn(points, {{0, 1, 3}, {1, 2, 3}});
  const auto boundary = boundary_of(mesh);
  std::vector<Index> nodes;
  REQUIRE(pair_along(mesh, std::vector<Index>{edge(mesh, 1, 3)}, nodes));
  CHECK(count_triangles(mesh) == 0);
  CHECK((count_quads(mesh) == 1 || count_quads(mesh) == 5));
  CHECK(defect(mesh) == "");
  CHECK(boundary_of(mesh) == boundary);
}

}  // namespace

TEST_CASE("pair_along: two triangles that share a side become a quad, or five where a corner is reflex or straight") {
  check_pair({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  check_pair({{0, 0}, {1, 0.9}, {2, 0}, {1, 1}});  // reflex
  check_pair({{0, 0}, {1, 0}, {2, 0}, {1, 1}});    // straight
  check_pair({{0, 0}, {1, 0}, {2, 0}, {9, 1}});
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    check_pair(random_pair(rng));
  }
}

TEST_CASE("pair_along: quads between the triangles are cut up, and every element is valid") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    // A row of quads between two triangles that turns at random, with nodes that are moved:
    //
    //     +---+      The chain crosses each quad to the opposite side or to a neighbouring one.
    //     | \ |
    // +---+---+
    // | \ |
    // +---+
    const Index size = 6;
    Mesh mesh = grid(size, size, Diagonals::falling);
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      mesh.set_point(v, mesh.point(v) + Vec2(rng.between(-0.24, 0.24), rng.between(-0.24, 0.24)));
    std::vector<std::pair<Index, Index>> cells{{0, 0}};
    while (cells.back() != std::pair(size - 1, size - 1)) {
      auto [x, y] = cells.back();
      (y + 1 == size || (x + 1 < size && rng.chance(0.5)) ? x : y) += 1;
      cells.emplace_back(x, y);
    }
    const auto node = [&](Index x, Index y) { return y * (size + 1) + x; };
    const auto is_end = [&](Index x, Index y) { return x == y && (x == 0 || x == size - 1); };
    bool convex = true;
    for (Index y = 0; y < size; ++y)
      for (Index x = 0; x < size; ++x)
        if (!is_end(x, y)) {
          const Index h = mesh.join_faces(edge(mesh, node(x + 1, y), node(x, y + 1)));
          convex = convex && mesh.is_valid_face(mesh.face(h));
        }
    REQUIRE(convex);
    // From the upper triangle of the first cell to the lower one of the last; the others in those two cells stay.
    std::vector<Index> path;
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
      const auto [x, y] = cells[i];
      const bool right = cells[i + 1].first > x;
      path.push_back(right ? edge(mesh, node(x + 1, y), node(x + 1, y + 1))
                           : edge(mesh, node(x + 1, y + 1), node(x, y + 1)));
    }
    const Mesh before = mesh;
    std::vector<Index> nodes;
    REQUIRE(pair_along(mesh, path, nodes));
    CHECK(count_triangles(mesh) == count_triangles(before) - 2);
    CHECK(defect(mesh) == "");
    CHECK(boundary_of(mesh) == boundary_of(before));
    CHECK(area_of(mesh) == doctest::Approx(area_of(before)));
  }
}

TEST_CASE("pair_along says no where two faces share more than one edge") {
  // 4 is inside, with two neighbours: the triangle 0 1 4 lies in a notch of the quad 1 2 0 4.
  Mesh mesh = drawn({{0, 0}, {2, 0}, {1, 3}, {3, 3}, {1, 1}}, {{0, 1, 4}, {4, 1, 2, 0}, {1, 3, 2}});
  std::vector<Index> nodes;
  mesh.begin();
  CHECK_FALSE(pair_along(mesh, std::vector<Index>{edge(mesh, 1, 4), edge(mesh, 1, 2)}, nodes));
  mesh.rollback();
  CHECK(count_quads(mesh) == 1);
}
