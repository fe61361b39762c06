// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes move, elements only get better.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "kernel/fixture.hpp"
#include "smoothing/node_energy.hpp"
#include "smoothing/smooth.hpp"
#include "smoothing/untangle.hpp"
#include "topology/edits.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using namespace qmorph::smoothing;

/// Quads and triangles, all valid.
Mesh random_mixed_mesh(Rng& rng) {
  Mesh mesh = random_mesh(rng);
  for (int i = 0; i < 60; ++i) {
    const auto h = Index(rng.below(mesh.half_edge_slots()));
    if (!mesh.is_live_half_edge(h) || !mesh.can_flip(h)) continue;
    mesh.begin();
    const Index f = mesh.face(mesh.join_faces(h));
    mesh.is_valid_face(f) ? mesh.commit() : mesh.rollback();
  }
  return mesh;
}

Star star_at(const Mesh& mesh, Index v) {
  Star star;
  star.look_around(mesh, v);
  return star;
}

std::vector<Index> free_nodes(const Mesh& mesh) {
  std::vector<Index> nodes;
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v) && !mesh.is_boundary(v) && !mesh.is_fixed(v)) nodes.push_back(v);
  return nodes;
}

/// Moves v in a random direction as far as the elements around stay valid.
void push_to_the_limit(Mesh& mesh, Index v, Rng& rng) {
  const Vec2 start = mesh.point(v), direction(rng.between(-3, 3), rng.between(-3, 3));
  double good = 0, bad = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (good + bad) / 2;
    mesh.set_point(v, start + middle * direction);
    (mesh.is_valid_star(v) ? good : bad) = middle;
  }
  mesh.set_point(v, start + good * direction);
}

}  // namespace

TEST_CASE("energy: it is 1 for each corner of a square, and not finite where a corner is not convex") {
  Mesh mesh = quad_grid(2, 2);
  const Energy energy = energy_around(mesh, 4);
  CHECK(energy.finite);
  CHECK(energy.value == doctest::Approx(12));  // three corners in each of four quads depend on the node
  CHECK(energy.gradient.norm() < 1e-12);
  CHECK(energy_at(mesh, 4, {1.3, 0.9}).value > 12);
  CHECK_FALSE(energy_at(mesh, 4, {2.5, 1}).finite);
  CHECK_FALSE(energy_at(mesh, 4, {0.5, 0.5}).finite);  // straight
  mesh.set_point(4, {2.5, 1});
  CHECK_FALSE(energy_around(mesh, 4).finite);
  CHECK(star_at(mesh, 4).regularised_with_derivatives(mesh.point(4), 0.1).finite);
}

TEST_CASE("energy: first and second derivatives are those of the value, by finite differences") {
  int checked = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    const Mesh mesh = random_mixed_mesh(rng);
    for (const Index v : free_nodes(mesh)) {
      CAPTURE(v);
      for (const double delta : {0.0, 0.05, 1.0}) {  // 0: the plain energy
        CAPTURE(delta);
        const auto value = [&](const Vec2& p) {
          return delta > 0 ? star_at(mesh, v).regularised(p, delta) : energy_at(mesh, v, p).value;
        };
        const Energy energy =
            delta > 0 ? star_at(mesh, v).regularised_with_derivatives(mesh.point(v), delta) : energy_around(mesh, v);
        if (!energy.finite || energy.value > 200) continue;  // differences of steep functions say nothing
        const Vec2 p = mesh.point(v), x(1e-4, 0), y(0, 1e-4);
        const double step = 1e-4;
        REQUIRE(value(p) == doctest::Approx(energy.value));
        const Vec2 gradient = Vec2(value(p + x) - value(p - x), value(p + y) - value(p - y)) / (2 * step);
        const double scale = energy.value + std::abs(energy.xx) + std::abs(energy.yy);
        REQUIRE((gradient - energy.gradient).norm() < 1e-4 * scale);
        const double xx = (value(p + x) - 2 * value(p) + value(p - x)) / (step * step);
        const double yy = (value(p + y) - 2 * value(p) + value(p - y)) / (step * step);
        const double xy =
            (value(p + x + y) - value(p + x - y) - value(p - x + y) + value(p - x - y)) / (4 * step * step);
        REQUIRE(std::abs(xx - energy.xx) < 1e-3 * scale);
        REQUIRE(std::abs(yy - energy.yy) < 1e-3 * scale);
        REQUIRE(std::abs(xy - energy.xy) < 1e-3 * scale);
        ++checked;
      }
    }
  }
  CHECK(checked > 500);
}

TEST_CASE("energy: the regularised one tends to the plain one as delta goes to zero") {
  Rng rng(3);
  const Mesh mesh = random_mixed_mesh(rng);
  for (const Index v : free_nodes(mesh))
    CHECK(star_at(mesh, v).regularised(mesh.point(v), 1e-9) == doctest::Approx(energy_around(mesh, v).value));
}

TEST_CASE("relax_node: the energy falls, elements stay valid, fixed and boundary nodes stay") {
  int moved = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mixed_mesh(rng);
    for (Index v = 0; v < mesh.vertex_slots(); ++v) {
      if (!mesh.is_live_vertex(v)) continue;
      if (!mesh.is_boundary(v) && rng.chance(0.2)) mesh.set_fixed(v);
      const bool is_free = !mesh.is_boundary(v) && !mesh.is_fixed(v);
      const Vec2 before = mesh.point(v);
      const double energy = energy_around(mesh, v).value, distance = relax_node(mesh, v);
      REQUIRE((mesh.point(v) != before) == (distance > 0));
      if (!is_free) REQUIRE(distance == 0);
      if (distance > 0) REQUIRE(energy_around(mesh, v).value < energy);
      REQUIRE(mesh.is_valid_star(v));
      moved += distance > 0;
    }
  }
  CHECK(moved > 500);
}

TEST_CASE("smooth never makes an element invalid, moves no fixed node, and lowers no good quality much") {
  double before_sum = 0, after_sum = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mixed_mesh(rng);
    for (const Index v : free_nodes(mesh))
      if (rng.chance(0.1)) mesh.set_fixed(v);
    const Mesh before = mesh;
    smooth(mesh, {});
    REQUIRE(defect(mesh) == "");
    REQUIRE(faces_of(mesh) == faces_of(before));
    const auto movable = free_nodes(mesh);
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      if (mesh.is_live_vertex(v) && std::find(movable.begin(), movable.end(), v) == movable.end())
        REQUIRE(mesh.point(v) == before.point(v));
    before_sum += topology::smallest_sine(before), after_sum += topology::smallest_sine(mesh);
  }
  CHECK(after_sum > before_sum);
}

TEST_CASE("smooth leaves a perfect grid where it is, and brings a moved node back") {
  Mesh mesh = quad_grid(4, 4);
  const Snapshot perfect = snapshot(mesh);
  smooth(mesh, {});
  CHECK(snapshot(mesh) == perfect);
  mesh.set_point(12, {2.4, 1.7});
  smooth(mesh, {});
  for (Index v = 0; v < mesh.vertex_slots(); ++v) CHECK((mesh.point(v) - Vec2(v % 5, v / 5)).norm() < 0.02);
}

TEST_CASE("smooth and smooth_near untangle a patch") {
  //   The middle node of 4 x 4 cells lies outside its ring.
  for (const Vec2& wrong : {Vec2(3.5, 3.5), Vec2(0.2, 2), Vec2(9, -3)}) {
    CAPTURE(wrong.x());
    Mesh mesh = quad_grid(4, 4);
    mesh.set_point(12, wrong);
    REQUIRE(defect(mesh) != "");
    Mesh copy = mesh;
    smooth(copy, {});
    CHECK(defect(copy) == "");
    const std::vector<Index> nodes = {12};
    CHECK(smooth_near(mesh, {}, nodes, 2));
    CHECK(defect(mesh) == "");
  }
}

TEST_CASE("smooth_near untangles neighbours together, where each alone is held by the other") {
  Mesh mesh = quad_grid(5, 5);
  const Vec2 a = mesh.point(14), b = mesh.point(15);  // two neighbours that have changed places
  mesh.set_point(14, b);
  mesh.set_point(15, a);
  const std::vector<Index> nodes = {14, 15};
  CHECK(smooth_near(mesh, {}, nodes, 1));
  CHECK(defect(mesh) == "");
}

TEST_CASE("smooth_near reports failure where nothing helps") {
  //  A chevron whose nodes are all on the boundary.
  Mesh mesh = drawn({{0, 0}, {3, 0}, {0.5, 0.5}, {0, 3}}, {{0, 1, 2, 3}});
  const std::vector<Index> nodes = {0, 1, 2, 3};
  const Snapshot before = snapshot(mesh);
  CHECK_FALSE(smooth_near(mesh, {}, nodes, 1));
  CHECK(snapshot(mesh) == before);
}

TEST_CASE("untangle_node goes where the smallest corner area is largest") {
  Mesh mesh = quad_grid(2, 2);
  mesh.set_point(4, {3, 3});
  CHECK(untangle_node(mesh, 4));
  CHECK((mesh.point(4) - Vec2(1, 1)).norm() < 1e-9);
  CHECK_FALSE(untangle_node(mesh, 4));  // best already
  CHECK_FALSE(untangle_node(mesh, 0));  // boundary
  mesh.set_point(4, {3, 3});
  mesh.set_fixed(4);
  CHECK_FALSE(untangle_node(mesh, 4));
  CHECK(mesh.point(4) == Vec2(3, 3));
}

TEST_CASE("untangle_node makes a star valid from anywhere if any position does") {
  int untangled = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mixed_mesh(rng);
    for (const Index v : free_nodes(mesh)) {
      // The present position is valid: it is the witness that one exists.
      const Vec2 valid = mesh.point(v);
      mesh.set_point(v, valid + Vec2(rng.between(-5, 5), rng.between(-5, 5)));
      if (!mesh.is_valid_star(v)) {
        untangle_node(mesh, v);
        REQUIRE(mesh.is_valid_star(v));
        ++untangled;
      }
      mesh.set_point(v, valid);
    }
  }
  CHECK(untangled > 200);
}

TEST_CASE("untangle_node leaves no better place, not even in fans of many elements") {
  // Of the corners that depend on v.
  const auto smallest_area = [](const Mesh& mesh, Index v) {
    double least = 1e300;
    Index h = mesh.out(v);
    do {
      const Index to_v = mesh.prev(h);
      least = std::min(least, cross(mesh.vector(h), -mesh.vector(to_v)));
      least = std::min(least, cross(mesh.vector(mesh.next(h)), -mesh.vector(h)));
      least = std::min(least, cross(mesh.vector(to_v), -mesh.vector(mesh.prev(to_v))));
      h = mesh.rotate_ccw(h);
    } while (h != mesh.out(v));
    return least;
  };
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    const Index count = 3 + Index(rng.between(0, seed % 4 == 0 ? 80 : 12));
    std::vector<Vec2> points{Vec2(rng.between(-2, 2), rng.between(-2, 2))};
    std::vector<std::array<Index, 3>> triangles;
    for (Index i = 0; i < count; ++i) {
      // Sometimes as regular as can be: then more than three areas are equal at the best place.
      const double turn = 2 * std::numbers::pi * double(i) / double(count),
                   radius = seed % 3 == 0 ? 1 : rng.between(0.5, 2);
      points.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
      triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
    }
    Mesh mesh(points, triangles);
    untangle_node(mesh, 0);
    const Vec2 found = mesh.point(0);
    const double best = smallest_area(mesh, 0);
    for (int i = 0; i < 64; ++i) {
      const double turn = 2 * std::numbers::pi * double(i % 16) / 16, step = std::pow(0.1, 1 + i / 16);
      mesh.set_point(0, found + step * Vec2(std::cos(turn), std::sin(turn)));
      REQUIRE(smallest_area(mesh, 0) < best + 1e-9);
    }
  }
}

TEST_CASE("raise_smallest_sine never lowers the smallest sine, and raises a small one") {
  int raised = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mixed_mesh(rng);
    for (const Index v : free_nodes(mesh)) {
      CAPTURE(v);
      const double before = mesh.smallest_sine_around(v);
      const Vec2 start = mesh.point(v);
      std::size_t work = 0;
      const bool moved = raise_smallest_sine(mesh, v, work);
      REQUIRE(moved == (mesh.point(v) != start));
      REQUIRE(mesh.smallest_sine_around(v) >= before);
      raised += mesh.smallest_sine_around(v) > before + 0.01;
    }
  }
  CHECK(raised > 200);
  Mesh mesh = quad_grid(2, 2);
  mesh.set_point(4, {1.8, 1.7});
  std::size_t work = 0;
  CHECK(raise_smallest_sine(mesh, 4, work));
  CHECK(mesh.smallest_sine_around(4) > 0.9);
  CHECK_FALSE(raise_smallest_sine(mesh, 0, work));
}

TEST_CASE("no move of a node makes a valid element invalid, however close to invalid it is") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Mesh mesh = random_mixed_mesh(rng);
    for (const Index v : free_nodes(mesh)) push_to_the_limit(mesh, v, rng);
    REQUIRE(defect(mesh) == "");
    for (const Index v : free_nodes(mesh)) {
      CAPTURE(v);
      relax_node(mesh, v);
      REQUIRE(mesh.is_valid_star(v));
      std::size_t work = 0;
      raise_smallest_sine(mesh, v, work);
      REQUIRE(mesh.is_valid_star(v));
    }
  }
}

TEST_CASE("has_immovable_fault: a straight or reflex corner of three nodes that stay is one, any other is none") {
  Mesh mesh = quad_grid(3, 3);
  // Quad 0 1 5 4 in the corner of the grid, 5 its only free node.
  const std::vector<Index> inner = {5, 6, 9, 10};
  CHECK_FALSE(has_immovable_fault(mesh, inner));
  mesh.set_point(5, {-1, -1});  // everything around it is turned over, but it can move
  CHECK_FALSE(has_immovable_fault(mesh, inner));
  mesh.set_point(5, {1, 1});
  mesh.set_point(0, {0.5, 0.5});  // straight: 1 0 4
  CHECK(has_immovable_fault(mesh, inner));
  CHECK(has_immovable_fault(mesh, std::vector<Index>{5}));
  CHECK_FALSE(has_immovable_fault(mesh, std::vector<Index>{6, 9, 10}));  // not around these
  const std::vector<Index> with_the_corner = {0, 5, 6, 9, 10};
  CHECK_FALSE(has_immovable_fault(mesh, with_the_corner));
}
