// SPDX-License-Identifier: GPL-2.0-or-later
// Every case of the thesis' tables: its pattern is drawn, found, and replaced, and so is its mirror image.
#include "cleanup/patterns/cases.hpp"

#include <doctest/doctest.h>

#include "cleanup/fixture.hpp"
#include "cleanup/patterns/match.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using namespace qmorph::cleanup;

/// What comes out: valences of the centre and of the ring's nodes (-1: vanished) and of the new ones, sorted.
struct Outcome {
  std::vector<int> centre_and_ring, made;
  bool operator==(const Outcome&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Outcome& o) {
  for (int v : o.centre_and_ring) out << v << ' ';
  out << "+ ";
  for (int v : o.made) out << v << ' ';
  return out;
}

/// Finds the case around `centre`, in the mesh itself or in a mirror, and replaces it.
Outcome resolve(Mesh& mesh, const Case& c, Index centre, bool in_mirror) {
  const GlossaryValence valence(mesh);
  const Pattern pattern(c);
  Ring ring;
  REQUIRE(read_ring(mesh, valence, centre, ring));
  if (in_mirror) ring = mirrored(mesh, ring);
  const int i = find_match(mesh, pattern, ring);
  REQUIRE(i >= 0);
  const Edges boundary = boundary_of(mesh);
  const Index nodes_before = mesh.vertex_slots();
  Dart dart = ring.darts[i];
  REQUIRE(node_of(mesh, dart) == centre);
  std::vector<Index> touched;
  REQUIRE(run(mesh, dart, c.composition, in_mirror, touched));
  CHECK(defect(mesh, false) == "");
  CHECK(boundary_of(mesh) == boundary);
  CHECK(count_quads(mesh) == count(mesh).faces);

  Outcome outcome;
  const auto add = [&](Index v) { outcome.centre_and_ring.push_back(mesh.is_live_vertex(v) ? valence(v) : -1); };
  add(centre);
  for (std::size_t k = 0; k < ring.nodes.size(); ++k) add(ring.nodes[(k + 2 * i) % ring.nodes.size()]);
  for (Index v = nodes_before; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v)) outcome.made.push_back(valence(v));
  std::sort(outcome.made.begin(), outcome.made.end());
  return outcome;
}

const Case& find_case(std::string_view name) {
  for (const auto cases : {connectivity_cases(), boundary_cases()})
    for (const Case& c : cases)
      if (c.name == name) return c;
  throw std::logic_error(std::string(name));
}

void check_both(const Mesh& mesh, std::string_view name, const Outcome& expected, Index centre = 0) {
  CAPTURE(name);
  Mesh plain = mesh, mirror = mirror_image(mesh);
  CHECK(resolve(plain, find_case(name), centre, false) == expected);
  CHECK(resolve(mirror, find_case(name), centre, true) == expected);
}

}  // namespace

TEST_CASE("cases: every row of the tables can be read") {
  for (const auto cases : {connectivity_cases(), boundary_cases()})
    for (const Case& c : cases) {
      CAPTURE(c.name);
      CHECK_NOTHROW(Pattern{c});
      CHECK(c.composition.find_first_not_of("0123456789") == std::string_view::npos);
      if (c.name.substr(0, 8) == "standard") CHECK(std::count(c.vertices.begin(), c.vertices.end(), '1') == 4);
    }
}

TEST_CASE("cases: connectivity patterns and what they become") {
  const struct {
    std::string_view name;
    std::vector<int> ring;  ///< a ring that the pattern fits
    Outcome after;
  } kRows[] = {
      // Standard: the outline's corners and sides become regular, inside is a grid or one pair 3-5.
      {"standard 1: 2 x 3 grid", {5, 3, 5, 3, 4, 4, 4, 4, 4, 3}, {{4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {4}}},
      {"standard 2: four to two rows, corner between",
       {4, 4, 4, 3, 4, 4, 4, 3, 5, 3, 5, 3},
       {{4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {3, 4, 5}}},
      {"standard 3: four to two rows",
       {5, 3, 4, 3, 5, 3, 4, 4, 4, 4, 4, 3},
       {{5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {3, 4, 4}}},
      {"standard 4: three to two rows at a corner",
       {5, 3, 4, 4, 4, 4, 4, 4, 4, 3},
       {{5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {3}}},
      {"standard 5: three to two rows beside a corner",
       {4, 4, 4, 3, 5, 3, 5, 3, 5, 3},
       {{3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {5}}},
      // Normal: two irregular nodes fewer, or three.
      {"normal 1: 3 and 3 beside 5", {3, 4, 4, 3, 4, 4, 4, 4, 4, 4}, {{4, 4, 4, 3, 4, 4, 4, 4, 4, 4, 4}, {}}},
      {"normal 2: its mirror image", {4, 4, 3, 4, 4, 4, 4, 4, 4, 3}, {{4, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {}}},
      {"normal 3: 3 on both sides of 5", {3, 4, 5, 4, 3, 4, 4, 4, 4, 4}, {{4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4}, {3}}},
      {"normal 4: 3 across from 3", {5, 3, 5, 4, 4, 4}, {{-1, 4, 4, 4, 4, 4, 4}, {}}},
      {"normal 5: 3 beside 3", {3, 5, 4, 5, 4, 4}, {{-1, -1, 4, 4, 5, 3, 4}, {}}},
      {"normal 5, both corners 5", {3, 5, 4, 4, 5, 4}, {{-1, -1, 4, 4, 4, 4, 4}, {}}},
      {"normal 6: 3 and 3 around a pair of regular nodes",
       {3, 4, 4, 3, 4, 4, 4, 5},
       {{-1, -1, 4, 4, -1, -1, 4, 4, 4}, {}}},
  };
  for (const auto& row : kRows) {
    const Case& c = find_case(row.name);
    check_both(surrounded(row.ring, std::string(c.vertices)), row.name, row.after);
  }
  CHECK(std::size(kRows) == connectivity_cases().size());
}

TEST_CASE("cases: a valence that does not fit, a missing corner, or a node on the boundary is no match") {
  const auto is_match = [](const Mesh& mesh, std::string_view name) {
    Ring ring;
    return read_ring(mesh, GlossaryValence(mesh), 0, ring) && find_match(mesh, Pattern(find_case(name)), ring) >= 0;
  };
  const std::vector<int> ring = {5, 3, 5, 3, 4, 4, 4, 4, 4, 3};
  const std::string_view name = "standard 1: 2 x 3 grid";
  CHECK(is_match(surrounded(ring, "1010010100"), name));
  CHECK_FALSE(is_match(surrounded(ring, "1010010010"), name));
  CHECK_FALSE(is_match(surrounded(ring), name));  // no node's angle is smaller than the others
  CHECK_FALSE(is_match(surrounded({5, 3, 5, 4, 4, 4, 4, 4, 4, 3}, "1010010100"), name));
  CHECK_FALSE(is_match(surrounded({5, 3, 3, 3, 4, 4, 4, 4, 4, 3}, "1010010100"), name));
  CHECK(is_match(surrounded({5, 3, 6, 3, 4, 6, 4, 4, 4, 3}, "1010010100"), name));  // 4+ and any
}

// A row between two sides of the boundary, node 0 on the lower one; 1 to 7 are around it. 0 has an edge too many, 3
// above it as well, 2 and 5 inside have one too few.
//
//    11------4------3-----10
//   /  \   /     / |      |
//  12    6--5    /  2------9
//   \   /   \  /    |      |
//    13-7-----0-----1------8
//       14 is left of 7, below 13
TEST_CASE("cases: 5 across from 5 in a row at the boundary") {
  const Mesh row = drawn({{0, 0},
                          {1, 0},
                          {1, 1},
                          {0, 2},
                          {-1, 2},
                          {-0.6, 1},
                          {-1.5, 1},
                          {-1, 0},
                          {2, 0},
                          {2, 1},
                          {2, 2},
                          {-2, 2},
                          {-2.5, 1.4},
                          {-2.5, 0.8},
                          {-2, 0}},
                         {{0, 1, 2, 3},
                          {0, 3, 4, 5},
                          {0, 5, 6, 7},
                          {1, 8, 9, 2},
                          {2, 9, 10, 3},
                          {5, 4, 11, 6},
                          {6, 11, 12, 13},
                          {6, 13, 14, 7}});
  REQUIRE(defect(row) == "");
  const Outcome regular{{4, 4, 4, 4, 4, 4, 4, 4}, {}};
  check_both(row, "boundary 1: 5 on 5 across a row", regular);
  check_both(mirror_image(row), "boundary 2: its mirror image", regular);
}

//   4-----3-----8               3-----8    Left: the row ends in two corners. Right: in one; 4 is flat, without
//   |     |\    |          4   / |\    |    an edge to the inside.
//   |     | 2---7           . /  | 2---7
//   |     |/    |        5----\  |/    |
//   5-----0--1--6              ---0-1--6
TEST_CASE("cases: 5 above the end of a row at the boundary") {
  const auto end_of_row = [](Vec2 fourth, Vec2 fifth) {
    return drawn({{0, 0}, {1, 0}, {1, 1}, {0, 2}, fourth, fifth, {2, 0}, {2, 1}, {2, 2}},
                 {{0, 1, 2, 3}, {0, 3, 4, 5}, {1, 6, 7, 2}, {2, 7, 8, 3}});
  };
  const Mesh corners = end_of_row({-1, 2}, {-1, 0}), flat = end_of_row({-1, 1.15}, {-2, 0.3});
  check_both(corners, "boundary 3: 5 above a row's end", {{4, 4, 4, 4, 5, 4}, {3}});
  check_both(mirror_image(corners), "boundary 4: its mirror image", {{4, 4, 5, 4, 4, 4}, {3}});
  check_both(flat, "boundary 3, flat end", {{4, 4, 4, 4, 4, 4}, {3}});
  check_both(mirror_image(flat), "boundary 4, flat end", {{4, 4, 4, 4, 4, 4}, {3}});
}

// A strip between the boundary nodes 4, 5 and 8, 1. Below 0 it is as above after half a turn.
//
//  12----11----10
//  |  \      /   \     .
//  4--3 \--2--.   9
//  |   \  /    \ /
//  5-----0-------1     1 and 5 have an edge too many, 3 and 7 inside one too few
//
TEST_CASE("cases: 5 on both sides of a node inside a strip") {
  enum : Index { e = 9, z, x, y, e2, z2, x2, y2 };
  const Mesh strip = drawn({{0, 0},
                            {1, 0},
                            {0.5, 1.1},
                            {-0.1, 0.8},
                            {-1, 1},
                            {-1, 0},
                            {-0.5, -1.1},
                            {0.1, -0.8},
                            {1, -1},
                            {1.3, 1},
                            {1, 2},
                            {0, 2.5},
                            {-1, 2},
                            {-1.3, -1},
                            {-1, -2},
                            {0, -2.5},
                            {1, -2}},
                           {{0, 1, 2, 3},
                            {0, 3, 4, 5},
                            {0, 5, 6, 7},
                            {0, 7, 8, 1},
                            {1, e, z, 2},
                            {2, z, x, y},
                            {3, 2, y, 4},
                            {5, e2, z2, 6},
                            {6, z2, x2, y2},
                            {7, 6, y2, 8}});
  REQUIRE(defect(strip, false) == "");
  check_both(strip, "boundary 5: 5 on both sides of a node inside", {{-1, 4, 4, 4, 4, 4, 4, -1, 4}, {}});
}

//  11----5----4----3----10
//  |    / \ .   . / \    |
//  12--6   .  .  .  2----9       4 is flat, without an edge to the inside
//  |   |     0      |    |
//  13--7-----'------1----8
TEST_CASE("cases: a flat corner between two 5 across from a 5") {
  const Mesh row =
      drawn({{0, 0},
             {1, 0},
             {1.2, 1},
             {1, 2},
             {0, 2},
             {-1, 2},
             {-1.2, 1},
             {-1, 0},
             {2, 0},
             {2, 1},
             {2, 2},
             {-2, 2},
             {-2, 1},
             {-2, 0}},
            {{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 5, 6, 7}, {1, 8, 9, 2}, {2, 9, 10, 3}, {6, 5, 11, 12}, {7, 6, 12, 13}});
  check_both(row, "boundary 6: a flat corner between two 5", {{4, 4, 4, 4, 4, 4, 4, 4}, {4}});
}
