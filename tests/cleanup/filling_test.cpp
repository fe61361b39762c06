// SPDX-License-Identifier: GPL-2.0-or-later
// Grids between three, four or five corners of a ring.
#include "cleanup/filling.hpp"

#include <doctest/doctest.h>

#include <array>

#include "cleanup/rings.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using cleanup::Filling;
using cleanup::filling_between;
using cleanup::quads_of;

std::optional<Filling> between_sides(const std::vector<int>& sides) {
  int n = 0;
  for (int side : sides) n += side;
  return filling_between(corners_of(sides), n);
}

/// Of three or five sides around a node with these spokes: a spoke ends on side i, the ones before and after cut it.
std::vector<int> sides_around(const std::vector<int>& spokes) {
  std::vector<int> sides;
  const std::size_t k = spokes.size();
  for (std::size_t i = 0; i < k; ++i) sides.push_back(spokes[(i + k - 1) % k] + spokes[(i + 1) % k]);
  return sides;
}

const std::vector<std::vector<int>> kSpokes = {{1, 1, 1},       {2, 1, 3},       {4, 4, 4},       {1, 5, 2},
                                               {1, 1, 1, 1, 1}, {2, 1, 3, 1, 2}, {3, 3, 3, 3, 3}, {1, 2, 3, 4, 5}};

}  // namespace

TEST_CASE("filling: the sides between three and five corners determine the spokes") {
  for (const auto& spokes : kSpokes) {
    const auto filling = between_sides(sides_around(spokes));
    REQUIRE(filling);
    CHECK(filling->corners == int(spokes.size()));
    for (std::size_t i = 0; i < spokes.size(); ++i) CHECK(filling->spokes[i] == spokes[i]);
  }
}

TEST_CASE("filling: four corners need opposite sides of the same length") {
  CHECK(between_sides({3, 2, 3, 2}));
  CHECK(between_sides({1, 1, 1, 1}));
  CHECK_FALSE(between_sides({3, 2, 4, 2}));
  CHECK_FALSE(between_sides({3, 2, 3, 4}));
  CHECK_FALSE(between_sides({2, 2, 3, 3}));
}

TEST_CASE("filling: there is none if a spoke would have half an edge, no edge, or a negative number") {
  CHECK_FALSE(between_sides({2, 2, 3}));        // an odd ring
  CHECK_FALSE(between_sides({2, 2, 4}));        // one spoke of length 0
  CHECK_FALSE(between_sides({1, 1, 4}));        // negative
  CHECK_FALSE(between_sides({2, 2, 2, 2, 3}));  // odd
  CHECK_FALSE(between_sides({2, 4, 2, 2, 2}));  // 0
  CHECK(between_sides({3, 3, 4}));
}

TEST_CASE("filling: the first corner may be anywhere on the ring") {
  const auto filling = filling_between(std::array{3, 6, 10, 13}, 14);
  REQUIRE(filling);
  CHECK(quads_of(*filling, 14) == 12);
  CHECK_FALSE(filling_between(std::array{3, 6, 10, 12}, 14));
}

TEST_CASE("filling: a polygon gets valid quads, as many as foretold, and one irregular node unless it has four sides") {
  std::vector<std::vector<int>> all = {{1, 1, 1, 1}, {4, 3, 4, 3}, {1, 6, 1, 6}, {5, 5, 5, 5}};
  for (const auto& spokes : kSpokes) all.push_back(sides_around(spokes));
  for (const auto& sides : all) {
    const std::string as_text = [&] {
      std::string text;
      for (int side : sides) text += std::to_string(side) + " ";
      return text;
    }();
    CAPTURE(as_text);
    const Edges boundary = boundary_of(polygon(sides));
    const Mesh mesh = filled_polygon(sides);
    CHECK(defect(mesh) == "");
    CHECK(boundary_of(mesh) == boundary);
    CHECK(count_quads(mesh) == count(mesh).faces);
    CHECK(count_quads(mesh) == quads_of(*between_sides(sides), int(boundary.size())));
    CHECK(irregular_nodes(mesh) == (sides.size() == 4 ? 0 : 1));
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      if (mesh.is_live_vertex(v) && !mesh.is_boundary(v) && mesh.valence(v) != 4)
        CHECK(mesh.valence(v) == sides.size());
  }
}

TEST_CASE("filling: a square becomes the even grid") {
  const Mesh mesh = filled_polygon({4, 4, 4, 4});
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f)) CHECK(mesh.smallest_sine(f) == doctest::Approx(1));
}

TEST_CASE("filling: two cells become the strip in the other direction") {
  Mesh mesh = quad_grid(4, 4);
  const std::vector<Index> outline = {11, 12, 13, 18, 17, 16};
  const std::vector<Index> faces = {mesh.face(edge(mesh, 11, 12)), mesh.face(edge(mesh, 12, 13))};
  std::vector<Index> nodes;
  const auto turned = filling_between(std::array{1, 2, 4, 5}, 6);
  REQUIRE(turned);
  REQUIRE(cleanup::fill(mesh, ring_through(mesh, outline), faces, *turned, nodes));
  CHECK(defect(mesh, false) == "");
  CHECK(mesh.find(12, 17) == kNone);
  CHECK(mesh.find(13, 16) == kNone);
  CHECK(mesh.find(11, 18) != kNone);
  CHECK(nodes == outline);
}
