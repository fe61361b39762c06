// SPDX-License-Identifier: GPL-2.0-or-later
// Hill climbing on what a whole region is worth.
#include "cleanup/raise_worth.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "cleanup/spoilt_grid.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;

double mean_shape(const Mesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f)) sum += topology::worst_corner_shape(mesh, f);
  return sum / double(count(mesh).faces);
}

}  // namespace

TEST_CASE("raise_worth: shapes get better on the whole, and no corner poor that was not; the boundary stays") {
  constexpr int kGrids = 30;
  double before = 0, after = 0;
  for (int seed = 1; seed <= kGrids; ++seed) {
    Rng rng(seed);
    Mesh mesh = spoilt_grid(rng);
    const Edges boundary = boundary_of(mesh);
    const double worst = topology::smallest_sine(mesh);
    before += mean_shape(mesh) / kGrids;
    cleanup::raise_worth(mesh, {}, {});
    after += mean_shape(mesh) / kGrids;
    CAPTURE(seed);
    CHECK(topology::smallest_sine(mesh) >= std::min(worst, 0.5));
    CHECK(defect(mesh) == "");
    CHECK(boundary_of(mesh) == boundary);
    CHECK(count_quads(mesh) == count(mesh).faces);
  }
  CAPTURE(before);
  CHECK(after > before + 0.05);
}

TEST_CASE("lift_worst: the worst corner gets better or nothing changes, always in the same way; the boundary stays") {
  constexpr int kGrids = 12;
  constexpr std::size_t kWork = 60'000;
  int lifted = 0;
  for (int seed = 1; seed <= kGrids; ++seed) {
    Rng rng(seed);
    Mesh mesh = spoilt_grid(rng);
    Mesh again = mesh;
    const Edges boundary = boundary_of(mesh);
    const double worst = topology::smallest_sine(mesh);
    const std::size_t changes = cleanup::lift_worst(mesh, {}, {mesh, kWork});
    CAPTURE(seed);
    CHECK(cleanup::lift_worst(again, {}, {again, kWork}) == changes);
    CHECK(faces_of(again) == faces_of(mesh));
    CHECK((changes > 0 ? topology::smallest_sine(mesh) > worst : topology::smallest_sine(mesh) == worst));
    CHECK(defect(mesh) == "");
    CHECK(boundary_of(mesh) == boundary);
    CHECK(count_quads(mesh) == count(mesh).faces);
    lifted += changes > 0;
  }
  CHECK(lifted > 0);
}

TEST_CASE("raise_worth: a grid of squares stays") {
  Mesh mesh = quad_grid(5, 4);
  const Polygons faces = faces_of(mesh);
  CHECK(cleanup::raise_worth(mesh, {}, {}) == 0);
  CHECK(faces_of(mesh) == faces);
}

TEST_CASE("raise_worth: nothing is tried without a budget, and each try costs something") {
  Rng rng(3);
  Mesh mesh = spoilt_grid(rng);
  const Polygons faces = faces_of(mesh);
  CHECK(cleanup::raise_worth(mesh, {}, {mesh, 0}) == 0);
  CHECK(faces_of(mesh) == faces);
  const std::size_t work = mesh.work(), little = 2000;
  constexpr std::size_t kOneTry = 4000;
  cleanup::raise_worth(mesh, {}, {mesh, little});
  CHECK(mesh.work() > work);
  CHECK(mesh.work() < work + little + kOneTry);
}
