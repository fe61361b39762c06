// SPDX-License-Identifier: GPL-2.0-or-later
// Chevrons, triangularly shaped quads, diamonds and connectivity cases in meshes where they have room to be mended.
#include "cleanup/patterns/pattern_cleanup.hpp"

#include <doctest/doctest.h>

#include "cleanup/fixture.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// All families of the thesis.
CleanupOptions everything() {
  CleanupOptions options;
  options.connectivity_cases = options.boundary_cases = options.transition_cases = true;
  options.diamond_cases = options.shape_cases = true;
  return options;
}

/// Runs it on the mesh and on its mirror image, which must come out as mirror images of each other: the same figures.
template <class CleanUp, class Check>
void in_both_hands(const Mesh& mesh, const CleanUp& clean_up, const Check& check) {
  for (Mesh m : {mesh, mirror_image(mesh)}) {
    const Edges boundary = boundary_of(m);
    REQUIRE(clean_up(m, everything(), SmoothingOptions{}, kernel::Budget{}) > 0);
    CHECK(defect(m) == "");
    CHECK(boundary_of(m) == boundary);
    check(m);
  }
}

}  // namespace

//  5------4
//  |    . |       The node 3 has 270 degrees, and the quad 3 4 6 2 is all that is there.
//  |  .   3---2
//  | 6  .   ' |
//  0----------1
TEST_CASE("chevron: at the boundary it is filled together with a neighbour") {
  const Mesh mesh =
      drawn({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0.3, 0.3}}, {{3, 4, 6, 2}, {6, 4, 5, 0}, {6, 0, 1, 2}});
  REQUIRE(topology::smallest_sine(mesh) < 0);
  in_both_hands(mesh, cleanup::eliminate_chevrons, [](const Mesh& m) {
    CHECK(count_quads(m) == 4);
    CHECK(m.valence(3) == 3);  // fill_3: one edge divides the angle
  });
}

TEST_CASE("chevron: inside, moving the node is enough") {
  Mesh mesh = quad_grid(2, 2);
  mesh.set_point(4, {0.3, 0.3});
  REQUIRE(topology::smallest_sine(mesh) < 0);
  in_both_hands(mesh, cleanup::eliminate_chevrons, [](const Mesh& m) {
    CHECK(count_quads(m) == 4);
    CHECK(topology::smallest_sine(m) > 0.9);
  });
}

TEST_CASE("chevron: the limit is an option, and without a chevron nothing is touched") {
  Mesh mesh = quad_grid(2, 2);
  mesh.set_point(4, {0.4, 0.4});
  CleanupOptions patient;
  patient.chevron_angle = 1.5 * std::numbers::pi;
  const Snapshot before = snapshot(mesh);
  CHECK(cleanup::eliminate_chevrons(mesh, patient, {}) == 0);
  CHECK(snapshot(mesh) == before);
}

//   10---9---8
//   |    |    |        The quad 2 3 5 1 has a corner of 180 degrees at the boundary node 2.
//   6----5----7
//   |   / \   |
//   0--1-2-3--4
TEST_CASE("boundary: a quad shaped like a triangle becomes a row") {
  const Mesh mesh = drawn({{-2, 0}, {-1, 0}, {0, 0}, {1, 0}, {2, 0}, {0, 1}, {-2, 1}, {2, 1}, {2, 2}, {0, 2}, {-2, 2}},
                          {{2, 3, 5, 1}, {0, 1, 5, 6}, {3, 4, 7, 5}, {6, 5, 9, 10}, {5, 7, 8, 9}});
  REQUIRE(topology::smallest_sine(mesh) == 0);
  in_both_hands(mesh, cleanup::clean_up_boundary, [](const Mesh& m) {
    CHECK(m.valence(2) == 3);
    CHECK(topology::smallest_sine(m) > 0.3);
  });
}

//  13-----8-----11
//  |      |      |      The quad 2 4 6 5 touches the boundary with one node; 4 and 5 have three edges, 2 has four and
//  12-----6-----10      6 has five.
//  |    /   \    |
//  7---5     4---9
//  |    \   /    |
//  1------2------3
TEST_CASE("boundary: a diamond closes, and a grid is left") {
  Mesh mesh =
      drawn({{9, 9},
             {-2, 0},
             {0, 0},
             {2, 0},
             {0.6, 1},
             {-0.6, 1},
             {0, 2},
             {-2, 1.2},
             {0, 3},
             {2, 1.2},
             {2, 2.2},
             {2, 3},
             {-2, 2.2},
             {-2, 3}},
            {{2, 3, 9, 4}, {2, 4, 6, 5}, {2, 5, 7, 1}, {6, 4, 9, 10}, {6, 10, 11, 8}, {6, 8, 13, 12}, {6, 12, 7, 5}});
  REQUIRE(cleanup::clean_up_boundary(mesh, everything(), {}) == 1);
  CHECK(count_quads(mesh) == 6);
  CHECK(irregular_nodes(mesh) == 0);
  CHECK(mesh.valence(2) == 3);
  CHECK(topology::smallest_sine(mesh) > 0.9);
}

TEST_CASE("connectivity: a pattern is resolved where the quads can take shape, and so is its mirror image") {
  Mesh mesh = surrounded({3, 4, 4, 3, 4, 4, 4, 4, 4, 4});  // normal 1
  smoothing::smooth(mesh, {});
  REQUIRE(defect(mesh) == "");
  REQUIRE(irregular_nodes(mesh) == 3);
  in_both_hands(mesh, cleanup::clean_up_connectivity, [](const Mesh& m) { CHECK(irregular_nodes(m) == 1); });
}

TEST_CASE("connectivity: a fixed node stays, and a case is left alone rather than make a bad quad") {
  Mesh mesh = surrounded({5, 3, 5, 4, 4, 4});  // normal 4: the centre and the node across from it are to meet
  smoothing::smooth(mesh, {});
  REQUIRE(defect(mesh) == "");
  Mesh free = mesh;
  for (Index v : {0u, 2u}) mesh.set_fixed(v);
  cleanup::clean_up_connectivity(mesh, everything(), {});
  CHECK(mesh.is_live_vertex(0));
  CHECK(mesh.is_live_vertex(2));
  CHECK(defect(mesh) == "");
  cleanup::clean_up_connectivity(free, everything(), {});
  CHECK(defect(free) == "");
}
