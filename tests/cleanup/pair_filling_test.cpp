// SPDX-License-Identifier: GPL-2.0-or-later
// Four corners whose opposite sides differ: a node of three edges and one of five.
#include "cleanup/pair_filling.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "cleanup/rings.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using cleanup::pair_filling_between;
using cleanup::PairChoice;
using cleanup::PairWish;

using Sides = std::array<int, 4>;

struct Filled {
  Mesh mesh;
  std::optional<PairChoice> choice;
};

std::vector<Vec2> outline_of(const Mesh& mesh) {
  std::vector<Vec2> points;
  for (Index v = 0; v + 1 < mesh.vertex_slots(); ++v) points.push_back(mesh.point(v));
  return points;
}

/// A square with these sides, its corners on the axes.
Filled fill_square(const Sides& sides, const Vec2& place, double quads_wanted, const cleanup::FillingSize& size = {}) {
  const std::vector<int> all(sides.begin(), sides.end()), places = corners_of(all);
  Filled filled{polygon(all), {}};
  Mesh& mesh = filled.mesh;
  const PairWish wish{outline_of(mesh), place, quads_wanted, size};
  filled.choice = pair_filling_between({places[0], places[1], places[2], places[3]}, wish);
  if (!filled.choice) return filled;
  std::vector<Index> outline, faces, nodes;
  for (Index i = 0; i + 1 < mesh.vertex_slots(); ++i) outline.push_back(i);
  for (Index f = 0; f < mesh.face_slots(); ++f) faces.push_back(f);
  if (!cleanup::fill(mesh, ring_through(mesh, outline), faces, filled.choice->filling, nodes))
    throw std::logic_error("no such filling");
  return filled;
}

/// Inner nodes with so many edges.
std::vector<Index> inner_nodes_with(const Mesh& mesh, Index edges) {
  std::vector<Index> found;
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v) && !mesh.is_boundary(v) && mesh.valence(v) == edges) found.push_back(v);
  return found;
}

}  // namespace

TEST_CASE("pair filling: whatever the sides, one node has three edges, one has five, all others are regular") {
  int filled = 0;
  for (int a = 4; a <= 9; ++a)
    for (int b = 4; b <= 9; ++b)
      for (int c = 4; c <= 9; ++c)
        for (int d = 4; d <= 9; ++d) {
          if ((a + b + c + d) % 2 != 0 || (a == c && b == d)) continue;
          CAPTURE(a);
          CAPTURE(b);
          CAPTURE(c);
          CAPTURE(d);
          const auto [mesh, choice] = fill_square({a, b, c, d}, Vec2::Zero(), 0.25 * (a + c) * (b + d));
          if (!choice) continue;
          ++filled;
          CHECK(defect(mesh, false) == "");
          CHECK(count_quads(mesh) == count(mesh).faces);
          CHECK(boundary_of(mesh) == boundary_of(polygon({a, b, c, d})));
          CHECK(inner_nodes_with(mesh, 3).size() == 1);
          CHECK(inner_nodes_with(mesh, 5).size() == 1);
          CHECK(irregular_nodes(mesh) == 2);
          for (Index v = 0; v < mesh.vertex_slots(); ++v)
            if (mesh.is_live_vertex(v) && mesh.is_boundary(v)) CHECK(mesh.valence(v) <= 3);
        }
  CHECK(filled > 300);
}

TEST_CASE("pair filling: there is none where a grid fits, and none where the sides differ by too much") {
  CHECK_FALSE(fill_square({6, 5, 6, 5}, Vec2::Zero(), 30).choice);
  CHECK_FALSE(fill_square({20, 3, 2, 3}, Vec2::Zero(), 30).choice);
}

TEST_CASE("pair filling: the number of quads is close to what is asked for, or there is no filling") {
  for (double wanted : {60.0, 80.0, 100.0}) {
    const cleanup::FillingSize close{0.9, 1.1};
    const auto [mesh, choice] = fill_square({10, 9, 8, 7}, Vec2::Zero(), wanted, close);
    if (choice) CHECK(std::abs(std::log(count_quads(mesh) / wanted)) < 0.11);
  }
  CHECK_FALSE(fill_square({10, 9, 8, 7}, Vec2::Zero(), 500).choice);
}

TEST_CASE("pair filling: the pair lies where it is asked for, as far as sizes allow") {
  for (const Vec2& place : {Vec2(0.4, 0), Vec2(-0.4, 0), Vec2(0, 0.4), Vec2(0, -0.4)}) {
    const auto [mesh, choice] = fill_square({20, 20, 18, 20}, place, 380);
    REQUIRE(choice);
    const Index three = inner_nodes_with(mesh, 3)[0], five = inner_nodes_with(mesh, 5)[0];
    const Vec2 middle = 0.5 * (mesh.point(three) + mesh.point(five));
    CHECK(middle.dot(place) > 0);
  }
}

TEST_CASE("pair filling: long sides that enclose far more quads than wanted are no work") {
  constexpr int kLong = 40'000;  // as many places, squared, would take a minute
  const int n = 4 * kLong + 8;
  const PairWish wish{std::vector<Vec2>(std::size_t(n), Vec2::Zero()), Vec2::Zero(), double(n), {}};
  CHECK(!pair_filling_between({0, kLong + 4, 2 * kLong + 4, 3 * kLong + 8}, wish));
}
