// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/tips.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/draft.hpp"

using qmorph::Index;
using qmorph::Patch;

namespace {

/// Two rows round a corner, in two spokes of 36 degrees: a pair of triangles at the tip, and two quads around it.
/// Before them other quads elsewhere.
Patch fan(std::size_t others) {
  Patch patch;
  patch.points.emplace_back(0, 0, 0);
  for (const double height : {0.01, 0.03})
    for (int line = 0; line < 3; ++line) {
      const double direction = line * std::numbers::pi / 5;
      patch.points.emplace_back(height * std::cos(direction), height * std::sin(direction), 0);
    }
  const Index first = Index(patch.points.size());
  for (const auto& [x, y] : {std::pair{1, 0}, {2, 0}, {2, 1}, {1, 1}}) patch.points.emplace_back(x, y, 0);
  patch.quads.assign(others, {first, first + 1, first + 2, first + 3});
  patch.quads.insert(patch.quads.end(), {{1, 4, 5, 2}, {2, 5, 6, 3}, {0, 1, 2, 3}});
  return patch;
}

}  // namespace

TEST_CASE("tips: the node in the middle goes outwards, so that the second row begins at a better corner") {
  const Patch before = fan(297);
  Patch after = before;
  qmorph::layers::widen_tips(after, 0, 1);
  CHECK(qmorph::test::smallest_sine(before.points, before.quads) < 0.6);
  CHECK(qmorph::test::smallest_sine(after.points, after.quads) > 0.69);
  const Index middle = 2;
  for (Index v = 0; v < after.points.size(); ++v) {
    CAPTURE(v);
    CHECK((after.points[v] != before.points[v]) == (v == middle));
  }
  const Eigen::Vector3d moved = after.points[middle];
  CHECK(moved.cross(before.points[middle]).norm() < 1e-15);  // along its edge
}

TEST_CASE("tips: a layer of few quads stays as it is") {
  Patch patch = fan(296);  // three quads would change, and that is more than one in a hundred
  qmorph::layers::widen_tips(patch, 0, 1);
  CHECK(patch.points == fan(296).points);
}

TEST_CASE("tips: between quads that the input had the node stays") {
  Patch patch = fan(1000);
  std::swap(patch.quads.front(), patch.quads[1000]);
  const Patch before = patch;
  qmorph::layers::widen_tips(patch, 1, 1);
  CHECK(patch.points == before.points);
}
