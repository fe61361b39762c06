// SPDX-License-Identifier: GPL-2.0-or-later
// The thesis' smoothing: its metric, its rule of acceptance, and what both kinds of move may and may not do.
#include "smoothing/thesis_smoothing.hpp"

#include <doctest/doctest.h>

#include "kernel/fixture.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"
#include "smoothing/constrained_laplacian.hpp"
#include "smoothing/distortion.hpp"
#include "smoothing/optimisation_based.hpp"
#include "smoothing/smooth.hpp"
#include "support/domains.hpp"
#include "support/invariants.hpp"
#include "support/seeds.hpp"

namespace {

using namespace qmorph;
using namespace qmorph::test;
using namespace qmorph::smoothing;

double metric_of(const std::vector<Vec2>& corners, double coincidence = 0) {
  std::vector<Index> face(corners.size());
  for (Index i = 0; i < face.size(); ++i) face[i] = i;
  const Mesh mesh = drawn(corners, {face});
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f)) return distortion(mesh, f, coincidence);
  return -9;
}

Eigen::Vector3d in_space(const Vec2& p) { return {p.x(), p.y(), 0}; }

/// A grid of quads whose inner nodes are moved at random; still valid if `share` is under a quarter.
Mesh jittered(Rng& rng, double share) {
  Mesh mesh = quad_grid(5, 5);
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_free(v))
      mesh.set_point(v, mesh.point(v) + Vec2(rng.between(-share, share), rng.between(-share, share)));
  return mesh;
}

std::vector<Index> free_nodes(const Mesh& mesh) {
  std::vector<Index> nodes;
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v) && mesh.is_free(v)) nodes.push_back(v);
  return nodes;
}

double worst_metric(const Mesh& mesh) {
  double worst = 1;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f)) worst = std::min(worst, distortion(mesh, f, 0.01));
  return worst;
}

}  // namespace

TEST_CASE("distortion: 1 for the best shapes, less for others, whatever their size") {
  for (const double size : {1e-6, 1.0, 1e6}) {
    CHECK(metric_of({{0, 0}, {size, 0}, {size, size}, {0, size}}, 0.01) == doctest::Approx(1));
    CHECK(metric_of({{0, 0}, {size, 0}, {0.5 * size, 0.8660254037844386 * size}}) == doctest::Approx(1));
    CHECK(metric_of({{0, 0}, {2 * size, 0}, {2 * size, size}, {0, size}}, 0.01) == doctest::Approx(0.8));
  }
}

TEST_CASE("distortion is the thesis metric of the report") {
  Rng rng(5);
  for (int i = 0; i < 2000; ++i) {
    const auto corner = [&] { return Vec2(rng.between(-1, 1), rng.between(-1, 1)); };
    const std::vector<Vec2> p{corner(), corner(), corner(), corner()};
    const QuadCorners quad{in_space(p[0]), in_space(p[1]), in_space(p[2]), in_space(p[3])};
    REQUIRE(metric_of(p) == doctest::Approx(thesis_metric(quad, {0, 0, 1})));
  }
}

TEST_CASE("distortion: nodes that nearly coincide cost one, by a share of the longest side") {
  const std::vector<Vec2> quad{{0, 0}, {1, 0}, {1, 1}, {0.995, 0.995}};
  CHECK(metric_of(quad, 0.01) == doctest::Approx(metric_of(quad, 0.001) - 1));
}

TEST_CASE("constrained Laplacian: the rule of acceptance") {
  const ThesisSmoothing options;
  const auto accepts = [&](int better, int worse, int much_better, int much_worse, double mean) {
    return is_acceptable({4, better, worse, much_better, much_worse, mean, 2, false}, options);
  };
  CHECK(accepts(4, 0, 0, 0, 0.1));
  CHECK_FALSE(accepts(0, 4, 0, 0, -0.001));  // all worse
  CHECK(accepts(1, 3, 0, 0, -0.04));         // a little worse in the mean is allowed, to let others move
  CHECK_FALSE(accepts(1, 3, 0, 0, -0.06));   // ... by MYMIN
  CHECK(accepts(1, 3, 1, 0, -0.04));
  CHECK_FALSE(accepts(3, 1, 0, 1, 0.2));  // more much worse than much better
  CHECK(accepts(2, 2, 1, 1, 0));
  CHECK_FALSE(is_acceptable({4, 4, 0, 0, 0, 0.1, 2, true}, options));     // an element is inverted
  CHECK_FALSE(is_acceptable({4, 4, 0, 0, 0, 0.1, 3.6, false}, options));  // THETAMAX
  ThesisSmoothing generous;
  generous.largest_angle = 4;
  generous.least_quality = 0.1;
  CHECK(is_acceptable({4, 4, 0, 0, 0, 0.1, 3.6, false}, generous));
  CHECK(is_acceptable({4, 1, 3, 0, 0, -0.06, 2, false}, generous));
}

TEST_CASE("constrained Laplacian: a node comes back to the middle; fixed nodes and short moves are left out") {
  Mesh mesh = quad_grid(2, 2);
  mesh.set_point(4, {1.3, 0.8});
  CHECK(move_to_neighbours(mesh, 4, {}) > 0.3);
  CHECK((mesh.point(4) - Vec2(1, 1)).norm() < 1e-12);
  CHECK(move_to_neighbours(mesh, 4, {}) == 0);
  CHECK(move_to_neighbours(mesh, 3, {}) == 0);  // boundary
  mesh.set_point(4, {1.005, 1});
  CHECK(move_to_neighbours(mesh, 4, {}) == 0);  // MOVETOLERANCE
  ThesisSmoothing patient;
  patient.move_tolerance = 1e-4;
  CHECK(move_to_neighbours(mesh, 4, patient) > 0);
  mesh.set_point(4, {1.3, 0.8});
  mesh.set_fixed(4);
  CHECK(move_to_neighbours(mesh, 4, {}) == 0);
}

TEST_CASE("constrained Laplacian: a move that would invert an element is shortened") {
  Rng rng(11);
  int moved = 0;
  for (int i = 0; i < 300; ++i) {
    Mesh mesh = jittered(rng, 0.24);
    for (Index v = 0; v < mesh.vertex_slots(); ++v)  // a boundary with dents
      if (mesh.is_boundary(v)) mesh.set_point(v, mesh.point(v) + Vec2(rng.between(-0.3, 0.3), rng.between(-0.3, 0.3)));
    for (Index v : free_nodes(mesh)) {
      std::vector<std::pair<Index, bool>> valid;
      for (Index f = 0; f < mesh.face_slots(); ++f)
        if (mesh.is_live_face(f)) valid.emplace_back(f, mesh.is_valid_face(f));
      moved += move_to_neighbours(mesh, v, {}) > 0;
      for (const auto& [f, was] : valid) REQUIRE((!was || mesh.is_valid_face(f)));
    }
  }
  CHECK(moved > 1000);
}

TEST_CASE("optimisation raises the smallest metric around a node by TOL, or leaves it") {
  Rng rng(12);
  int moved = 0;
  for (int i = 0; i < 100; ++i) {
    Mesh mesh = jittered(rng, 0.24);
    for (Index v : free_nodes(mesh)) {
      const double before = smallest_distortion_around(mesh, v, 0.01);
      const double distance = optimise_node(mesh, v, {});
      const double after = smallest_distortion_around(mesh, v, 0.01);
      REQUIRE((distance > 0 ? after >= before + 1e-5 : after == before));
      REQUIRE(mesh.is_valid_star(v));
      moved += distance > 0;
    }
  }
  CHECK(moved > 1000);
}

TEST_CASE("smoothing by the thesis: better, valid, with fixed nodes in place, and the same at every scale") {
  Rng rng(13);
  for (int i = 0; i < 50; ++i) {
    Mesh mesh = jittered(rng, 0.24), small = mesh;
    mesh.set_fixed(14);
    small.set_fixed(14);
    constexpr double kSmall = 0x1p-20;
    for (Index v = 0; v < small.vertex_slots(); ++v) small.set_point(v, kSmall * small.point(v));
    const Vec2 fixed = mesh.point(14);
    const double before = worst_metric(mesh);
    smooth_by_thesis(mesh, {}, free_nodes(mesh));
    smooth_by_thesis(small, {}, free_nodes(small));
    CHECK(defect(mesh) == "");
    CHECK(worst_metric(mesh) > before);
    CHECK(mesh.point(14) == fixed);
    for (Index v = 0; v < mesh.vertex_slots(); ++v) REQUIRE((small.point(v) / kSmall - mesh.point(v)).norm() < 1e-9);
  }
}

//  |  |  |  |  |     A dent in the boundary: the mean of its neighbours is no good place for the node above it.
//  +--+--+--+--+
//  |  | _+_ |  |
//  +--+'   '+--+
TEST_CASE("smoothing by the thesis: OBSTOL says which nodes are optimised, MAXITER how often") {
  Mesh start = quad_grid(4, 4);
  start.set_point(2, {2.3, 0.9});
  start.set_point(7, {2.2, 1.1});
  REQUIRE(defect(start) == "");
  const auto smoothed = [&](double optimise_below, int most_passes) {
    ThesisSmoothing options;
    options.optimise_below = optimise_below;
    options.most_passes = most_passes;
    Mesh mesh = start;
    smooth_by_thesis(mesh, options, free_nodes(mesh));
    CHECK(defect(mesh) == "");
    return mesh;
  };
  CHECK(snapshot(smoothed(1, 0)) == snapshot(start));
  CHECK(worst_metric(smoothed(1, 20)) > worst_metric(smoothed(-4, 20)) + 0.1);
  CHECK(worst_metric(smoothed(1, 20)) > worst_metric(smoothed(1, 3)));
}

TEST_CASE("smoothing by the thesis: an invalid element is untangled") {
  Mesh mesh = quad_grid(4, 4);
  mesh.set_point(12, {3.3, 3.2});
  REQUIRE(defect(mesh) != "");
  SmoothingOptions options;
  options.method = SmoothingMethod::thesis;
  smooth(mesh, options);
  CHECK(defect(mesh) == "");
}

TEST_CASE("random domains keep every invariant when the thesis smooths them") {
  Options options;
  options.smoothing.method = SmoothingMethod::thesis;
  for (std::uint64_t seed = 0; seed < seeds(60, 10); ++seed) {
    const Domain domain = random_domain(seed);
    CAPTURE(seed);
    CHECK(broken_invariants(domain.patch, convert(domain.patch, options).mesh) == std::vector<std::string>{});
  }
}
