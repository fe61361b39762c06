// SPDX-License-Identifier: GPL-2.0-or-later
// Rows that lean across gaps between junctions.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bands/least_of.hpp"
#include "bands/relay_rows.hpp"
#include "geometry/predicates.hpp"
#include "kernel/fixture.hpp"
#include "qmorph/convert.hpp"
#include "support/invariants.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

/// Two junctions of three gaps each (equilateral triangles), with a gap between them and two more at each, the sides of
/// which have so many edges. Lengths are in edges.
struct Junctions {
  Junctions(double gap, int sides) : width(gap), edges(sides) {
    const double height = width * std::sqrt(3.0) / 2;
    for (int side : {0, 1}) {  // of the middle gap: its lower nodes, then the upper ones
      first[side] = Index(points.size());
      for (int i = 0; i <= edges; ++i) points.emplace_back(i, side * width);
    }
    apex[0] = add({-height, width / 2}), apex[1] = add({edges + height, width / 2});
    arm(first[0], apex[0]), arm(apex[0], first[1]);
    arm(first[1] + Index(edges), apex[1]), arm(apex[1], first[0] + Index(edges));
  }

  Index add(const Vec2& p) {
    points.push_back(p);
    return Index(points.size() - 1);
  }

  /// Rectangles on the left of the edge from a to b.
  void arm(Index a, Index b) {
    const Vec2 across = points[b] - points[a], out = Vec2(-across.y(), across.x()) / across.norm();
    Index c = a, d = b;
    for (int i = 1; i <= edges; ++i) {
      const Index e = add(points[a] + double(i) * out), f = add(points[b] + double(i) * out);
      quads.push_back({c, d, f, e});
      c = e, d = f;
    }
  }

  Index lower(int i) const { return first[0] + Index(i); }
  Index upper(int i) const { return first[1] + Index(i); }

  double width;
  int edges;
  std::vector<Vec2> points;
  std::vector<std::array<Index, 4>> quads;  ///< of the four gaps outside
  std::array<Index, 2> first{}, apex{};
};

/// The middle gap as quads that lean by an edge.
kernel::Mesh leaning(const Junctions& gaps) {
  auto quads = gaps.quads;
  quads.push_back({gaps.apex[0], gaps.lower(0), gaps.lower(1), gaps.upper(0)});
  for (int i = 0; i + 1 < gaps.edges; ++i)
    quads.push_back({gaps.upper(i), gaps.lower(i + 1), gaps.lower(i + 2), gaps.upper(i + 1)});
  quads.push_back({gaps.upper(gaps.edges - 1), gaps.lower(gaps.edges), gaps.apex[1], gaps.upper(gaps.edges)});
  return {gaps.points, quads, {}};
}

/// All gaps and junctions in triangles.
Patch triangulated(const Junctions& gaps) {
  Patch patch;
  for (const Vec2& p : gaps.points) patch.points.emplace_back(p.x(), p.y(), 0);
  auto quads = gaps.quads;
  for (int i = 0; i < gaps.edges; ++i)
    quads.push_back({gaps.lower(i), gaps.lower(i + 1), gaps.upper(i + 1), gaps.upper(i)});
  for (const auto& q : quads)
    patch.triangles.push_back({q[0], q[1], q[2]}), patch.triangles.push_back({q[0], q[2], q[3]});
  patch.triangles.push_back({gaps.apex[0], gaps.lower(0), gaps.upper(0)});
  patch.triangles.push_back({gaps.lower(gaps.edges), gaps.apex[1], gaps.upper(gaps.edges)});
  return patch;
}

}  // namespace

TEST_CASE("relaying: a row that leans between two junctions is laid anew, and no quad of it leans") {
  for (const double width : {0.1, 0.2, 0.4})
    for (const int edges : {4, 5, 12}) {
      CAPTURE(width);
      CAPTURE(edges);
      kernel::Mesh mesh = leaning(Junctions(width, edges));
      const auto outline = boundary_of(mesh);
      REQUIRE(kernel::find_defects(mesh) == std::vector<std::string>());
      REQUIRE(topology::smallest_sine(mesh) < 0.4);
      CHECK(bands::relay_leaning_rows(mesh, {}, {}) == 1);
      CHECK(kernel::find_defects(mesh) == std::vector<std::string>());
      CHECK(count_quads(mesh) == count(mesh).faces);
      CHECK(boundary_of(mesh) == outline);
      CHECK(topology::smallest_sine(mesh) > 0.45);
    }
}

TEST_CASE("relaying: rows that do not lean stay as they are") {
  const Junctions gaps(0.2, 5);
  kernel::Mesh mesh(gaps.points, gaps.quads, {});
  const auto before = topology::connectivity(mesh);
  CHECK(bands::relay_leaning_rows(mesh, {}, {}) == 0);
  CHECK(topology::connectivity(mesh) == before);
}

TEST_CASE("conversion: gaps that meet, each as wide as a part of an edge, have no quad that leans") {
  for (const double width : {0.1, 0.2, 0.4})
    for (const int edges : {4, 9, 40}) {
      CAPTURE(width);
      CAPTURE(edges);
      const Patch patch = triangulated(Junctions(width, edges));
      const Conversion conversion = convert(patch);
      CHECK(broken_invariants(patch, conversion.mesh) == std::vector<std::string>());
      CHECK(conversion.mesh.triangles.empty());
      CHECK(least_of(conversion.mesh) > 0.4);
    }
}
