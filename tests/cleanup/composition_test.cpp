// SPDX-License-Identifier: GPL-2.0-or-later
// The codes of compositions, one by one, and the compositions that mend shapes.
#include "cleanup/patterns/composition.hpp"

#include <doctest/doctest.h>

#include "cleanup/fixture.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using cleanup::Dart;
using cleanup::run;

//   2----1----5
//   |    |    |
//   3----0----4
Mesh two_quads() { return drawn({{0, 0}, {0, 1}, {-1, 1}, {-1, 0}, {1, 0}, {1, 1}}, {{0, 1, 2, 3}, {0, 4, 5, 1}}); }

struct After {
  Polygons faces;
  Index node, other_end;
  std::vector<Index> element;  ///< of the dart
};

/// Runs a composition from the dart at 0 on the edge 0-1, in the left element or the right one.
After after(Mesh mesh, std::string_view composition, bool left, bool mirrored = false) {
  const Index h = edge(mesh, 0, 1);
  Dart dart = left ? Dart{h, false} : Dart{Mesh::twin(h), true};
  std::vector<Index> nodes;
  REQUIRE(run(mesh, dart, composition, mirrored, nodes));
  CHECK(defect(mesh, false) == "");
  After result{faces_of(mesh), node_of(mesh, dart), 0, {}};
  result.other_end = dart.at_target ? mesh.origin(dart.h) : mesh.target(dart.h);
  Index e = dart.h;
  for (Index i = 0; i < mesh.degree(mesh.face(dart.h)); ++i, e = mesh.next(e)) result.element.push_back(mesh.origin(e));
  std::rotate(result.element.begin(), std::min_element(result.element.begin(), result.element.end()),
              result.element.end());
  return result;
}

void check(const After& result, const Polygons& faces, Index node, Index other_end, const std::vector<Index>& element) {
  CHECK(result.faces == faces);
  CHECK(result.node == node);
  CHECK(result.other_end == other_end);
  CHECK(result.element == element);
}

const Polygons kTwo = {{0, 1, 2, 3}, {0, 4, 5, 1}};

}  // namespace

//   2----1----5     2----1----5
//   | \     / |     | \  |   '|     On the left fill_3 (5): 6 joins 0 to the nodes beside 1. On the right
//   |    6    |     |  6---7  |     fill_4 (6), from the left quad: 6 joins 0 and 2, 7 joins 1 and 4.
//   |    |    |     |  |    \ |
//   3----0----4     3--0------4
TEST_CASE("composition: fill_3 and fill_4") {
  check(after(two_quads(), "5", true), {{0, 4, 5, 6}, {0, 6, 2, 3}, {1, 2, 6, 5}}, 0, 6, {0, 6, 2, 3});
  check(after(two_quads(), "5", false), {{0, 4, 5, 6}, {0, 6, 2, 3}, {1, 2, 6, 5}}, 0, 6, {0, 4, 5, 6});
  check(after(two_quads(), "6", true), {{0, 4, 7, 6}, {0, 6, 2, 3}, {1, 2, 6, 7}, {1, 7, 4, 5}}, 0, 6, {0, 6, 2, 3});
  check(after(two_quads(), "6", false), {{0, 4, 5, 6}, {0, 6, 7, 3}, {1, 2, 3, 7}, {1, 7, 6, 5}}, 0, 6, {0, 4, 5, 6});
}

TEST_CASE("composition: the edge moves on clockwise or counter-clockwise, and the other way in a mirror image") {
  const Polygons clockwise = {{0, 4, 5, 3}, {1, 2, 3, 5}}, counter = {{0, 4, 2, 3}, {1, 2, 4, 5}};
  check(after(two_quads(), "8", true), clockwise, 3, 5, {1, 2, 3, 5});
  check(after(two_quads(), "8", false), clockwise, 3, 5, {0, 4, 5, 3});
  check(after(two_quads(), "9", true), counter, 4, 2, {0, 4, 2, 3});
  check(after(two_quads(), "9", false, true), clockwise, 3, 5, {0, 4, 5, 3});
  check(after(two_quads(), "8", true, true), counter, 4, 2, {0, 4, 2, 3});
}

TEST_CASE("composition: a quad is split by a node in its middle") {
  check(after(two_quads(), "7", true), {{0, 1, 2, 6}, {0, 4, 5, 1}, {0, 6, 2, 3}}, 0, 1, {0, 1, 2, 6});
  check(after(two_quads(), "7", false), {{0, 1, 2, 3}, {0, 4, 5, 6}, {0, 6, 5, 1}}, 0, 1, {0, 6, 5, 1});
}

TEST_CASE("composition: a quad closes at the opposite node or half-way, unless that moves what must stay") {
  // Node 5 is in the middle of a grid of 2 x 2 cells with corners 0, 2, 6, 8.
  for (const char* code : {"3", "4"}) {
    Mesh mesh = quad_grid(3, 3);
    Dart dart{edge(mesh, 5, 6), false};
    std::vector<Index> nodes;
    REQUIRE(run(mesh, dart, code, false, nodes));
    CHECK_FALSE(mesh.is_live_vertex(5));
    CHECK(node_of(mesh, dart) == 10);
    CHECK(mesh.point(10) == (*code == '3' ? Vec2(2, 2) : Vec2(1.5, 1.5)));
    CHECK(mesh.valence(10) == 6);
    CHECK(count_quads(mesh) == 8);
    CHECK(defect(mesh, false) == "");
    // On what was the edge 5-6, in the element beyond it.
    CHECK(mesh.face(dart.h) == mesh.face(mesh.find(1, 2)));
  }
  const auto closes = [](Mesh mesh, const char* code, Index from, Index to) {
    Dart dart{edge(mesh, from, to), false};
    std::vector<Index> nodes;
    return run(mesh, dart, code, false, nodes) && mesh.is_live_vertex(from);
  };
  Mesh fixed = quad_grid(3, 3);
  fixed.set_fixed(5);
  CHECK_FALSE(closes(fixed, "3", 5, 6));
  CHECK(closes(fixed, "4", 5, 6));  // half-way is at 5 then
  fixed.set_fixed(10);
  CHECK_FALSE(closes(fixed, "4", 5, 6));
}
