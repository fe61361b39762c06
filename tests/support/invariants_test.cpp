// SPDX-License-Identifier: GPL-2.0-or-later
// The checker itself: a good result passes, and each rule is broken once on purpose.
#include "support/invariants.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

namespace {

using Eigen::Vector3d;
using qmorph::Index;
using qmorph::kNone;
using qmorph::Patch;
using qmorph::QuadMesh;
using qmorph::test::broken_invariants;

//  6---7---8      Eight triangles and a quad that is there already (1-2-5-4), in nine points; 9 lies in square 3-4-7-6.
//  |\9/| / |      4-5 is a constraint, node 4 is on it, node 9 is free.
//  |/ \|/  |
//  3---4===5
//  | / |   |
//  0---1---2
struct Example {
  Patch in;
  QuadMesh out;

  Example() {
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) in.points.emplace_back(x, y, 0);
    in.points.emplace_back(0.5, 1.5, 0);
    in.triangles = {{0, 1, 4}, {0, 4, 3}, {3, 4, 9}, {4, 7, 9}, {7, 6, 9}, {6, 3, 9}, {4, 5, 8}, {4, 8, 7}};
    in.quads = {{1, 2, 5, 4}};
    in.constraints = {{5, 4}};

    out.points.assign(in.points.begin(), in.points.begin() + 9);
    out.source = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    out.quads = {{1, 2, 5, 4}, {0, 1, 4, 3}, {3, 4, 7, 6}, {4, 5, 8, 7}};
  }

  /// The rules that complain, each once, in alphabetical order.
  std::vector<std::string> rules() const {
    std::vector<std::string> names;
    for (const std::string& line : broken_invariants(in, out)) {
      const std::string name = line.substr(0, line.find(':'));
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

using Rules = std::vector<std::string>;

/// Lists of rules as text, so that a failure can be read.
std::string text(const Rules& rules) {
  std::string result;
  for (const std::string& rule : rules) result += (result.empty() ? "" : ", ") + rule;
  return result;
}

}  // namespace

TEST_CASE("invariants: a good result has nothing to complain about") {
  Example e;
  SUBCASE("as drawn") {}
  SUBCASE("node 9 kept and moved: it splits square 3-4-7-6 into five") {
    e.out.points.emplace_back(0.4, 1.6, 0);
    e.out.source.push_back(9);
    for (const auto& [x, y] : {std::pair(0.6, 1.6), std::pair(0.6, 1.4), std::pair(0.4, 1.4)}) {
      e.out.points.emplace_back(x, y, 0);
      e.out.source.push_back(kNone);
    }
    // 9, 10, 11, 12 lie inside, clockwise from upper left
    e.out.quads[2] = {12, 11, 10, 9};
    e.out.quads.insert(e.out.quads.end(), {{3, 4, 11, 12}, {4, 7, 10, 11}, {7, 6, 9, 10}, {6, 3, 12, 9}});
  }
  SUBCASE("clockwise") {
    for (auto& t : e.in.triangles) std::swap(t[0], t[1]);
    for (auto& q : e.in.quads) std::swap(q[0], q[2]);
    for (auto& q : e.out.quads) std::swap(q[0], q[2]);
  }
  SUBCASE("no further off the plane than the input is") { e.in.points[5].z() = e.out.points[5].z() = 1e-7; }
  CHECK(text(broken_invariants(e.in, e.out)) == "");
}

TEST_CASE("invariants: regions and their parity") {
  Example e;
  // upper left and right hang together by 4-7, lower left by 3-4; 4-5 has the kept quad on its other side
  CHECK(qmorph::test::count_regions(e.in).regions == 1);
  CHECK(qmorph::test::count_regions(e.in).odd == 0);
  e.in.constraints.push_back({0, 4});
  CHECK(qmorph::test::count_regions(e.in).regions == 2);
  CHECK(qmorph::test::count_regions(e.in).odd == 2);
}

TEST_CASE("invariants: every broken rule is seen, and only that") {
  Example e;
  SUBCASE("I1: a boundary node has moved by one bit") {
    e.out.points[0].x() = std::numeric_limits<double>::min();
    CHECK(text(e.rules()) == "fixed node");
  }
  SUBCASE("I1: minus zero is another bit pattern") {
    e.out.points[0].x() = -0.0;
    CHECK(text(e.rules()) == "fixed node");
  }
  SUBCASE("I1: a boundary node has been left out") {
    e.out.points.erase(e.out.points.begin() + 8);
    e.out.source.pop_back();
    e.out.quads.pop_back();
    e.out.triangles = {{4, 5, 7}};
    CHECK(text(e.rules()) == "area, boundary, fixed node, parity");
  }
  SUBCASE("I1: a boundary edge got a node") {
    e.out.points.emplace_back(0.5, 2, 0);
    e.out.source.push_back(kNone);
    e.out.quads[2] = {3, 4, 9, 6};
    e.out.triangles = {{4, 7, 9}};
    CHECK(text(e.rules()) == "boundary, parity");
  }
  SUBCASE("I2: a node that was to stay has moved") {
    e.in.fixed = {4};
    e.in.quads.clear();
    e.in.constraints.clear();
    e.in.triangles.insert(e.in.triangles.end(), {{1, 2, 5}, {1, 5, 4}});
    CHECK(text(e.rules()) == "");
    e.out.points[4].x() += 1e-9;
    CHECK(text(e.rules()) == "fixed node");
  }
  SUBCASE("I2: the constraint is no edge any more") {
    e.in.constraints.push_back({0, 4});
    CHECK(text(e.rules()) == "constraint, parity");
  }
  SUBCASE("a kept quad starts at another corner") {
    e.out.quads[0] = {2, 5, 4, 1};
    CHECK(text(e.rules()) == "kept quad");
  }
  SUBCASE("a kept quad is gone") {
    e.out.quads.erase(e.out.quads.begin());
    CHECK(text(e.rules()) == "area, boundary, conformity, kept quad");
  }
  SUBCASE("I3: an element twice") {
    e.out.quads.push_back(e.out.quads[3]);
    CHECK(text(e.rules()) == "area, boundary, conformity, parity");
  }
  SUBCASE("I3: a node twice at one place") {
    e.out.points.push_back(e.out.points[4]);
    e.out.source.push_back(kNone);
    e.out.quads[3] = {9, 5, 8, 7};
    CHECK(text(e.rules()) == "boundary, conformity, parity");
  }
  SUBCASE("I3: a node that nothing uses") {
    e.out.points.emplace_back(0.5, 0.5, 0);
    e.out.source.push_back(kNone);
    CHECK(text(e.rules()) == "conformity");
  }
  SUBCASE("I4: an element the other way round") {
    e.out.quads[2] = {3, 6, 7, 4};
    CHECK(text(e.rules()) == "area, boundary, conformity, orientation");
  }
  SUBCASE("I4: a straight corner") {
    e.in.points[7] = e.out.points[7] = {0.5, 1.5, 0};  // on the line from 4 to 6
    e.in.triangles.erase(e.in.triangles.begin() + 2, e.in.triangles.begin() + 6);
    e.in.triangles.push_back({3, 4, 6});
    e.in.points.pop_back();
    e.in.triangles.push_back({4, 7, 6});
    CHECK(text(e.rules()) == "orientation");
  }
  SUBCASE("I5: two triangles in an even region") {
    e.out.quads.pop_back();
    e.out.triangles = {{4, 5, 8}, {4, 8, 7}};
    CHECK(text(e.rules()) == "parity");
  }
  SUBCASE("I5: one in each odd region is right") {
    e.in.constraints.push_back({8, 4});
    e.out.quads.pop_back();
    e.out.triangles = {{4, 5, 8}, {4, 8, 7}};
    CHECK(text(e.rules()) == "");  // 4-5-8 is a region of 3 sides, the rest has 9
    e.out.quads.pop_back();
    e.out.triangles.push_back({3, 4, 6});
    e.out.triangles.push_back({4, 7, 6});
    CHECK(text(e.rules()) == "parity");  // three in the rest
  }
  SUBCASE("I6: off the plane") {
    e.in.constraints.clear();
    e.in.quads.clear();
    e.in.triangles.insert(e.in.triangles.end(), {{1, 2, 5}, {1, 5, 4}});
    e.out.points[4].z() = 1e-6;
    CHECK(text(e.rules()) == "area");
  }
  SUBCASE("source: out of order, out of range, a new node before an old one") {
    SUBCASE("order") { std::swap(e.out.source[0], e.out.source[1]); }
    SUBCASE("range") { e.out.source[8] = 10; }
    SUBCASE("new first") { e.out.source[0] = kNone; }
    CHECK(text(e.rules()) == "source");
  }
  SUBCASE("malformed: sizes, numbers, coordinates, collapsed elements") {
    SUBCASE("sizes") { e.out.source.pop_back(); }
    SUBCASE("numbers") { e.out.quads[1][0] = 9; }
    SUBCASE("coordinates") { e.out.points[3].y() = std::numeric_limits<double>::quiet_NaN(); }
    SUBCASE("collapsed") { e.out.quads[1] = {0, 1, 4, 4}; }
    CHECK(text(e.rules()) == "malformed");
  }
}
