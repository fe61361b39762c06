// SPDX-License-Identifier: GPL-2.0-or-later
/// The second opinion: each kind of spoilt result is found.

#include "qmorph/check.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>

using namespace qmorph;

namespace {

//  6---7---8     two by two cells; each is two triangles in the patch
//  |   |   |     and one quad in the result
//  3---4---5
//  |   |   |     the edge 1-4 is a constraint, node 4 is free otherwise
//  0---1---2
struct Case {
  Patch patch;
  QuadMesh mesh;
  Case() {
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) patch.points.emplace_back(i, j, 0.5);
    for (const Index corner : {0u, 1u, 3u, 4u}) {
      const std::array<Index, 4> quad{corner, corner + 1, corner + 4, corner + 3};
      patch.triangles.push_back({quad[0], quad[1], quad[2]});
      patch.triangles.push_back({quad[0], quad[2], quad[3]});
      mesh.quads.push_back(quad);
    }
    mesh.points = patch.points;
    for (Index i = 0; i < 9; ++i) mesh.source.push_back(i);
  }
};

std::string defect_after(const std::function<void(Case&)>& spoil) {
  Case the_case;
  spoil(the_case);
  const std::optional<Defect> defect = find_defect(the_case.patch, the_case.mesh);
  return defect ? defect->what : "";
}

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("check: a good result has no defect") {
  CHECK(defect_after([](Case&) {}) == "");
  CHECK(defect_after([](Case& c) { c.mesh.points[4].x() += 0.2; }) == "");
  CHECK(defect_after([](Case& c) { c.patch.constraints = {{1, 4}}; }) == "");
}

TEST_CASE("check: nodes that may not move") {
  CHECK(
      mentions(defect_after([](Case& c) { c.mesh.points[1].x() += 1e-15; }), "a fixed node has moved at (1, 0, 0.5)"));
  CHECK(mentions(defect_after([](Case& c) {
                   c.patch.constraints = {{1, 4}};
                   c.mesh.points[4].x() += 0.1;
                 }),
                 "a fixed node has moved at (1, 1, 0.5)"));
  CHECK(mentions(defect_after([](Case& c) {
                   c.patch.fixed = {4};
                   c.mesh.points[4].x() += 0.1;
                 }),
                 "a fixed node has moved"));
}

TEST_CASE("check: edges that are gone") {
  CHECK(mentions(defect_after([](Case& c) { c.mesh.quads.pop_back(); }), "uses its node at (2, 2, 0.5)"));
  CHECK(mentions(defect_after([](Case& c) {  // half of a quad: one side of it inside is open now
                   const auto quad = c.mesh.quads[3];
                   c.mesh.quads.pop_back();
                   c.mesh.triangles.push_back({quad[1], quad[2], quad[3]});
                 }),
                 "more boundary edges"));
  CHECK(mentions(defect_after([](Case& c) {  // the other half: two sides of the outline are gone
                   const auto quad = c.mesh.quads[3];
                   c.mesh.quads.pop_back();
                   c.mesh.triangles.push_back({quad[0], quad[1], quad[3]});
                   c.mesh.triangles.push_back({quad[0], quad[1], quad[2]});
                 }),
                 "overlap"));
  CHECK(mentions(defect_after([](Case& c) { c.patch.constraints = {{0, 4}}; }), "constraint edge from (0, 0, 0.5)"));
}

TEST_CASE("check: elements that are wrong") {
  CHECK(mentions(defect_after([](Case& c) { c.mesh.points[4] = {1.6, 0.3, 0.5}; }), "not convex"));
  CHECK(mentions(defect_after([](Case& c) { c.mesh.points[4] = {1, std::nan(""), 0.5}; }), "not convex"));
  CHECK(mentions(defect_after([](Case& c) { std::swap(c.mesh.quads[0][0], c.mesh.quads[0][2]); }), "overlap"));
  CHECK(defect_after([](Case& c) { std::swap(c.mesh.quads[0][1], c.mesh.quads[0][3]); }) != "");
  CHECK(defect_after([](Case& c) { c.mesh.quads.push_back(c.mesh.quads[0]); }) != "");
  CHECK(mentions(defect_after([](Case& c) { c.mesh.quads[0][0] = 99; }), "does not exist"));
}

TEST_CASE("check: a corner of 180 degrees is not a corner") {
  // Node 4 in the middle between 1 and 5.
  CHECK(mentions(defect_after([](Case& c) { c.mesh.points[4] = {1.5, 0.5, 0.5}; }), "not convex"));
  CHECK(mentions(defect_after([](Case& c) { c.mesh.points[4] = {1.5, 0.5 + 1e-14, 0.5}; }), "not convex"));
}

TEST_CASE("check: references") {
  CHECK(mentions(defect_after([](Case& c) { c.mesh.source.pop_back(); }), "where its nodes come from"));
  CHECK(mentions(defect_after([](Case& c) { c.mesh.source[4] = 0; }), "one origin"));
  CHECK(mentions(defect_after([](Case& c) {
                   c.mesh.points.emplace_back(7, 7, 7);
                   c.mesh.source.push_back(kNone);
                 }),
                 "uses its node at (7, 7, 7)"));
}

TEST_CASE("check: area out of the plane") {
  CHECK(mentions(defect_after([](Case& c) { c.mesh.points[4].z() += 0.1; }), "area"));
}

TEST_CASE("check: quads of the input come first, unchanged") {
  CHECK(defect_after([](Case& c) {
          c.patch.quads = {c.mesh.quads[3]};
          c.patch.triangles.resize(6);
        }) != "");
  CHECK(defect_after([](Case& c) {
          c.patch.quads = {c.mesh.quads[0]};
          c.patch.triangles.erase(c.patch.triangles.begin(), c.patch.triangles.begin() + 2);
        }) == "");
}
