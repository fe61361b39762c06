// SPDX-License-Identifier: GPL-2.0-or-later
#include <doctest/doctest.h>

#include <cmath>

#include "qmorph/patch.hpp"
#include "qmorph/quality.hpp"

namespace {

using Eigen::Vector3d;
using qmorph::QuadMesh;

// 6---7---8     Three squares and a triangle; the square 4-5-8-7 is cut and its
// |   | /       upper left half is the triangle. Node 4 is the only interior node.
// 3---4---5
// |   |   |
// 0---1---2
QuadMesh cut_squares() {
  QuadMesh mesh;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) mesh.points.emplace_back(x, y, 0);
  mesh.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}};
  mesh.triangles = {{4, 8, 7}};
  return mesh;
}

using Histogram = std::map<int, std::size_t>;

}  // namespace

TEST_CASE("measure: nodes are counted by distinct edges, inside and on the boundary") {
  QuadMesh mesh = cut_squares();
  SUBCASE("node 4 is on the boundary as long as a quarter is missing") {
    const qmorph::Quality q = qmorph::measure(mesh, Vector3d::UnitZ());
    CHECK(q.quads == 3);
    CHECK(q.triangles == 1);
    CHECK(q.inverted == 0);
    CHECK(q.interior_nodes == 0);
    CHECK(q.irregular_share() == 0);
    // corners 0, 2, 5, 6, 8: 2 edges, at most 90 degrees; 1, 3, 7: 3 edges, 180 degrees; 4: 5 edges, 315 degrees
    CHECK(q.boundary_valence == Histogram{{4, 8}, {5, 1}});
  }
  SUBCASE("closed by a second triangle, it has five edges") {
    mesh.triangles.push_back({4, 5, 8});
    const qmorph::Quality q = qmorph::measure(mesh, Vector3d::UnitZ());
    CHECK(q.interior_nodes == 1);
    CHECK(q.irregular_nodes == 1);
    CHECK(q.irregular_share() == 1);
    CHECK(q.valence == Histogram{{5, 1}});
  }
  SUBCASE("a node that no element uses is not counted") {
    mesh.points.emplace_back(7, 7, 0);
    const qmorph::Quality q = qmorph::measure(mesh, Vector3d::UnitZ());
    CHECK(q.boundary_valence == Histogram{{4, 8}, {5, 1}});
  }
}

TEST_CASE("measure: squares are perfect, seen from the right side") {
  const QuadMesh mesh = cut_squares();
  for (const qmorph::Quality& q : {qmorph::measure(mesh, Vector3d::UnitZ()), qmorph::measure(mesh)}) {
    CHECK(q.scaled_jacobian_min == doctest::Approx(1));
    CHECK(q.scaled_jacobian_p1 == doctest::Approx(1));
    CHECK(q.scaled_jacobian_mean == doctest::Approx(1));
    CHECK(q.scaled_jacobian_below_03 == 0);
    CHECK(q.eta_mean == doctest::Approx(1));
    CHECK(q.thesis_mean == doctest::Approx(1));
    CHECK(q.angle_min_deg == doctest::Approx(90));
    CHECK(q.angle_max_deg == doctest::Approx(90));
  }
  const qmorph::Quality behind = qmorph::measure(mesh, -Vector3d::UnitZ());
  CHECK(behind.inverted == 4);
  CHECK(behind.scaled_jacobian_min == doctest::Approx(-1));
  CHECK(behind.angle_min_deg == doctest::Approx(270));
}

TEST_CASE("measure: a bad element in a plane is found even without a normal") {
  QuadMesh mesh = cut_squares();
  SUBCASE("upside down") { mesh.quads[2] = {6, 7, 4, 3}; }
  SUBCASE("a chevron") {
    mesh.points.emplace_back(0.25, 1.75, 0);
    mesh.quads[2] = {3, 9, 7, 6};
  }
  CHECK(qmorph::measure(mesh).inverted == 1);
}

TEST_CASE("measure: on a curved surface each element has its own normal") {
  QuadMesh mesh;  // a roof: two squares that meet at the ridge 1-4 at a right angle
  mesh.points = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {0, 1, 0}, {1, 1, 1}, {2, 1, 0}};
  mesh.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  CHECK(qmorph::measure(mesh).inverted == 0);
  CHECK(qmorph::measure(mesh).thesis_min == doctest::Approx(4 * std::sqrt(2.0) / 6));
}

TEST_CASE("measure: an empty mesh and a mesh of triangles have no bad figures") {
  QuadMesh mesh;
  CHECK(qmorph::measure(mesh).scaled_jacobian_min == 1);
  mesh = cut_squares();
  mesh.quads.clear();
  const qmorph::Quality q = qmorph::measure(mesh);
  CHECK(q.triangles == 1);
  CHECK(q.scaled_jacobian_mean == 1);
  CHECK(q.inverted == 0);
}

TEST_CASE("accumulator: percentiles are those of NumPy, over all surfaces together") {
  // Parallelograms of 1 to 41 degrees in two surfaces; p5 is rank 2 (3 degrees), p1 lies 0.4 of the way from the first
  // to the second.
  qmorph::QualityAccumulator accumulator;
  const auto sine = [](double degrees) { return std::sin(degrees * 3.14159265358979323846 / 180); };
  for (int half = 0; half < 2; ++half) {
    QuadMesh mesh;
    for (int degrees = 41 - half; degrees >= 1; degrees -= 2) {
      const auto first = qmorph::Index(mesh.points.size());
      const double s = sine(degrees), c = sine(90 - degrees), x = 3 * degrees;
      for (const Vector3d& p :
           {Vector3d(x, 0, 0), Vector3d(x + 1, 0, 0), Vector3d(x + 1 + c, s, 0), Vector3d(x + c, s, 0)})
        mesh.points.push_back(p);
      mesh.quads.push_back({first, first + 1, first + 2, first + 3});
    }
    accumulator.add(mesh.points, mesh.triangles, mesh.quads, Vector3d::UnitZ());
  }
  const qmorph::Quality q = accumulator.result();
  CHECK(q.quads == 41);
  CHECK(q.scaled_jacobian_min == doctest::Approx(sine(1)));
  CHECK(q.scaled_jacobian_p1 == doctest::Approx(0.6 * sine(1) + 0.4 * sine(2)));
  CHECK(q.scaled_jacobian_p5 == doctest::Approx(sine(3)));
  CHECK(q.scaled_jacobian_below_03 == doctest::Approx(17.0 / 41));  // sin 17 = 0.292, sin 18 = 0.309
  CHECK(q.angle_min_deg == doctest::Approx(1));
  CHECK(q.angle_max_deg == doctest::Approx(179));
}

TEST_CASE("accumulators: two that are added up are like one that saw both meshes") {
  const QuadMesh first = cut_squares();
  QuadMesh second = first;
  for (std::size_t i = 0; i < second.points.size(); ++i) second.points[i].x() += 0.3 * second.points[i].y();
  second.triangles.clear();
  qmorph::QualityAccumulator one, other, both;
  one.add(first.points, first.triangles, first.quads, Vector3d::UnitZ());
  other.add(second.points, second.triangles, second.quads, Vector3d::UnitZ());
  for (const QuadMesh& mesh : {first, second}) both.add(mesh.points, mesh.triangles, mesh.quads, Vector3d::UnitZ());
  one.add(other);
  const qmorph::Quality sum = one.result(), expected = both.result();
  CHECK(sum.quads == expected.quads);
  CHECK(sum.triangles == expected.triangles);
  CHECK(sum.valence == expected.valence);
  CHECK(sum.boundary_valence == expected.boundary_valence);
  CHECK(sum.scaled_jacobian_min == expected.scaled_jacobian_min);
  CHECK(sum.scaled_jacobian_p1 == expected.scaled_jacobian_p1);
  CHECK(sum.scaled_jacobian_mean == doctest::Approx(expected.scaled_jacobian_mean));
  CHECK(sum.thesis_min == expected.thesis_min);
  CHECK(sum.thesis_mean == doctest::Approx(expected.thesis_mean));
  CHECK(sum.eta_mean == doctest::Approx(expected.eta_mean));
  CHECK(sum.angle_min_deg == expected.angle_min_deg);
  CHECK(sum.angle_max_deg == expected.angle_max_deg);
  CHECK(sum.triangle_metric_min == expected.triangle_metric_min);

  qmorph::QualityAccumulator nothing;
  nothing.add(other);
  CHECK(nothing.result().angle_min_deg == other.result().angle_min_deg);
}
