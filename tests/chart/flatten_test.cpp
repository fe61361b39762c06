// SPDX-License-Identifier: GPL-2.0-or-later
// Surfaces laid flat.
#include "chart/flatten.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "chart/chart.hpp"
#include "chart/coarse.hpp"
#include "chart/fixture.hpp"

using namespace qmorph;
using namespace qmorph::test;
using chart::Flattening;
using Eigen::Vector3d;

namespace {

Patch mapped(Patch patch, const std::function<Vector3d(double, double)>& map) {
  for (Vector3d& p : patch.points) p = map(p.x(), p.y());
  return patch;
}

Flattening flat(const Patch& patch) {
  const space::Background surface(patch.points, patch.triangles);
  return chart::flatten(surface, patch.points.size());
}

/// The largest relative difference between distances in the chart and in the plane that the patch was bent from.
double difference(const Patch& plane, const Flattening& chart) {
  double most = 0;
  for (std::size_t i = 0; i < plane.points.size(); i += 7)
    for (std::size_t j = 0; j < i; j += 5) {
      const double wanted = (plane.points[i] - plane.points[j]).norm();
      most = std::max(most, std::abs((chart.points[i] - chart.points[j]).norm() / wanted - 1));
    }
  return most;
}

Patch cap(double angle, int n = 24) {  // of a sphere, as far from the pole
  return mapped(plate(n, n), [&](double x, double y) {
    const Vec2 p(2 * x / n - 1, 2 * y / n - 1);
    const double most = std::max(std::abs(p.x()), std::abs(p.y())), r = most * angle;
    const Vec2 along = most > 0 ? Vec2(p.normalized()) : Vec2(1, 0);
    return Vector3d(std::sin(r) * along.x(), std::sin(r) * along.y(), std::cos(r));
  });
}

}  // namespace

TEST_CASE("flatten: surfaces that were rolled up are unrolled") {
  const Patch plane = plate(40, 12);
  SUBCASE("a cylinder, all but closed") {
    const double radius = 40 / (2 * std::numbers::pi) * 1.02;
    const Flattening chart = flat(mapped(plane, [&](double x, double y) {
      return Vector3d(radius * std::cos(x / radius), radius * std::sin(x / radius), y);
    }));
    CHECK(chart.flipped == 0);
    CHECK(chart.distortion < 1.01);
    CHECK(difference(plane, chart) < 0.01);
  }
  SUBCASE("a cone, twice around") {
    const double tip = 0.12;
    const Flattening chart = flat(mapped(plane, [&](double x, double y) {
      const Vec2 q(x + 20, y - 6);
      const double r = q.norm(), angle = std::atan2(q.y(), q.x()) / tip;
      return Vector3d(r * tip * std::cos(angle), r * tip * std::sin(angle), r * std::sqrt(1 - tip * tip));
    }));
    CHECK(chart.flipped == 0);
    CHECK(difference(plane, chart) < 0.05);
  }
  SUBCASE("a plane in space, at any scale") {
    for (const double scale : {1e-9, 1.0, 1e9}) {
      const Flattening chart =
          flat(mapped(plane, [&](double x, double y) { return Vector3d(scale * Vector3d(x, 0.6 * y, 0.8 * y)); }));
      CHECK(chart.distortion == doctest::Approx(1));
      CHECK(chart.scaling == doctest::Approx(1));
    }
  }
}

TEST_CASE("flatten: the more a surface is curved, the more it is distorted, and nothing is turned over") {
  double before = 1;
  for (const double angle : {0.3, 0.6, 0.9, 1.2, 1.5}) {
    const Flattening chart = flat(cap(angle));
    CAPTURE(angle);
    CHECK(chart.flipped == 0);
    CHECK(chart.distortion > before);
    before = chart.distortion;
  }
  CHECK(flat(cap(0.9)).distortion < 1.2);
  CHECK(before > 1.3);
}

TEST_CASE("flatten: a few points of many lay out the others nearly as well as all do at once") {
  const int n = 40;
  for (const double angle : {0.3, 0.6, 0.9}) {
    CAPTURE(angle);
    const chart::Piece piece = Start(cap(angle, n)).whole();
    const space::Background surface(piece.points, piece.halves, piece.barriers());
    const std::optional<Flattening> by_few = chart::flatten_by_few(piece, surface);
    REQUIRE(by_few);
    CHECK(by_few->flipped == 0);
    CHECK(by_few->distortion - 1 < 1.2 * (chart::flatten(surface, piece.points.size()).distortion - 1));
  }
  SUBCASE("what unrolls does so, though a few points of it say less") {
    const double radius = n / 3.0;
    const chart::Piece piece = Start(mapped(plate(n, n), [&](double x, double y) {
                                 return Vector3d(radius * std::cos(x / radius), radius * std::sin(x / radius), y);
                               })).whole();
    CHECK(chart::Chart(piece).flattening().distortion < 1.001);
  }
}

TEST_CASE("flatten: holes do no harm, as long as what surrounds them can lie flat") {
  Patch patch = plate(20, 20);
  patch = pierced(patch, {10, 10, 0}, 4);
  const Patch bent = mapped(patch, [](double x, double y) { return Vector3d(x, y, std::sin(x / 4)); });
  const Flattening chart = flat(bent);
  CHECK(chart.flipped == 0);
  CHECK(chart.distortion < 1.02);
}

TEST_CASE("flatten: a tube that is closed cannot lie flat, and that shows") {
  Rng rng(1);
  const Flattening chart = flat(tube(3, 0.5, 0.15, 0, rng));
  CHECK((chart.flipped > 0 || chart.distortion > 1.5));
}

TEST_CASE("flatten: triangles without area cause no NaN") {
  Patch patch = plate(6, 6);
  patch.points[24] = patch.points[25];                             // two nodes at one place
  patch.points[16] = 0.5 * (patch.points[15] + patch.points[17]);  // three in a row
  const Flattening chart = flat(mapped(patch, [](double x, double y) { return Vector3d(x, y, 0.05 * x * x); }));
  for (const Vec2& p : chart.points) CHECK(p.allFinite());
}
