// SPDX-License-Identifier: GPL-2.0-or-later
// Large fans get rings of nodes around their centre.
#include "engine/fans.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "kernel/fixture.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"
#include "support/invariants.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

struct Fan {
  std::vector<Vec2> points;  ///< the centre is the first
  std::vector<std::array<Index, 3>> triangles;
};

/// A circle of `count` nodes around its middle, each `radius(i)` away.
template <class Radius>
Fan disc(Index count, const Radius& radius) {
  Fan fan{{{0, 0}}, {}};
  for (Index i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    fan.points.push_back(radius(i) * Vec2(std::cos(angle), std::sin(angle)));
    fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return fan;
}

/// A circle of `count` nodes, all joined to one of them.
Fan shell(Index count) {
  Fan fan;
  for (Index i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    fan.points.emplace_back(std::cos(angle), std::sin(angle));
  }
  for (Index i = 1; i + 1 < count; ++i) fan.triangles.push_back({0, i, i + 1});
  return fan;
}

Index most_edges(const Mesh& mesh) {
  Index most = 0;
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v)) most = std::max(most, mesh.valence(v));
  return most;
}

/// What grading may not change; the mesh afterwards.
Mesh graded(const Fan& fan) {
  const Mesh before(fan.points, fan.triangles);
  Mesh mesh = before;
  grade_fans(mesh);
  CHECK(defect(mesh) == "");
  CHECK(boundary_of(mesh) == boundary_of(before));
  CHECK(area_of(mesh) == doctest::Approx(area_of(before)));
  CHECK(count_faces(mesh, 3) == count(mesh).faces);
  for (Index v = 0; v < before.vertex_slots(); ++v) {
    CHECK(mesh.is_live_vertex(v));
    CHECK(mesh.point(v) == before.point(v));
  }
  return mesh;
}

Patch patch_of(const Fan& fan) {
  Patch patch;
  for (const Vec2& p : fan.points) patch.points.emplace_back(p.x(), p.y(), 0);
  patch.triangles = fan.triangles;
  return patch;
}

}  // namespace

TEST_CASE("grade_fans: ordinary nodes stay as they are") {
  Mesh mesh = grid(6, 6, Diagonals::rising);
  const Snapshot before = snapshot(mesh);
  CHECK(grade_fans(mesh) == 0);
  CHECK(snapshot(mesh) == before);
}

TEST_CASE("grade_fans: a disc and a shell of very many triangles get rings, until few meet anywhere") {
  for (const Index n : {17, 18, 50, 51, 333, 1000}) {
    CAPTURE(n);
    CHECK(most_edges(graded(disc(n, [](Index) { return 1.0; }))) <= 16);
    CHECK(most_edges(graded(shell(n + 2))) <= 32);  // edges too short for a ring stay, two or so for each
  }
}

TEST_CASE("grade_fans: works for nodes at any distances") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    const double spread = rng.power_of_two(-8, 4);
    std::vector<double> radii(std::size_t(rng.range(17, 60)));
    for (double& r : radii) r = 1 + spread * rng.uniform();
    graded(disc(Index(radii.size()), [&](Index i) { return radii[i]; }));
  }
}

TEST_CASE("a fan of very many triangles converts well") {
  for (const Fan& fan : {disc(300, [](Index) { return 1.0; }), shell(302), disc(301, [](Index) { return 1.0; })}) {
    const Patch patch = patch_of(fan);
    const QuadMesh mesh = convert(patch).mesh;
    const auto broken = broken_invariants(patch, mesh);
    CHECK_MESSAGE(broken.empty(), broken.front());
    CHECK(measure(mesh).scaled_jacobian_mean > 0.8);
  }
}
