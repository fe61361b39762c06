// SPDX-License-Identifier: GPL-2.0-or-later
// The metric sheet: one element per row, what each metric says about it. Values by hand or from the closed form beside
// them.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "qmorph/quality.hpp"

namespace {

using Eigen::Vector3d;
using qmorph::QuadCorners;
using qmorph::TriangleCorners;

QuadCorners quad(double x0, double y0, double x1, double y1, double x2, double y2, double x3, double y3) {
  return {Vector3d(x0, y0, 0), Vector3d(x1, y1, 0), Vector3d(x2, y2, 0), Vector3d(x3, y3, 0)};
}

struct Row {
  std::string element;
  QuadCorners corners;
  double scaled_jacobian, eta, thesis, angle_min, angle_max;
};

constexpr double kPi = std::numbers::pi;
const double kTwoDegrees = kPi / 90;

const Row kSheet[] = {
    {"unit square", quad(0, 0, 1, 0, 1, 1, 0, 1), 1, 1, 1, 90, 90},
    // Rectangle a x b: all four triangles are the same, 4ab / (2 (a^2 + b^2)).
    {"rectangle 2 x 1", quad(0, 0, 2, 0, 2, 1, 0, 1), 1, 1, 0.8, 90, 90},
    {"rhombus of 30 degrees", quad(0, 0, 2, 0, 2 + std::sqrt(3.0), 1, std::sqrt(3.0), 1), 0.5, 1.0 / 3,
     // the flat half: twice the area 2, squares 4 + 4 + (8 + 4 sqrt 3)
     8 / (16 + 4 * std::sqrt(3.0)), 30, 150},
    // A thin parallelogram with corners of 2 and 178 degrees: the thesis takes 1 off under 6 degrees.
    {"sliver of 2 degrees",
     quad(0, 0, 1, 0, 1 + std::cos(kTwoDegrees), std::sin(kTwoDegrees), std::cos(kTwoDegrees), std::sin(kTwoDegrees)),
     std::sin(kTwoDegrees), 1 - 88.0 / 90, 4 * std::sin(kTwoDegrees) / (4 + 2 * std::cos(kTwoDegrees)) - 1, 2, 178},
    // Corner 2 lies on the line from 1 to 3: a triangle with a node in the middle of a side.
    {"collapsed to a triangle, 180 degrees", quad(0, 0, 1, 0, 0.5, 0.5, 0, 1), 0, 0, 0, 45, 180},
    // Corners 2 and 3 at one place. Triangle 0-2-3 has no area, the angles at 2 and 3 are not defined.
    {"collapsed to a triangle, two nodes at one place", quad(0, 0, 1, 0, 0, 1, 0, 1), 0, 0, -1, 0, 90},
    // Arrow head with its notch at corner 2: the sides there are (-1, 3)/4 and (3, -1)/4. Triangle 1-2-3 is upside
    // down.
    {"chevron", quad(0, 0, 1, 0, 0.25, 0.25, 0, 1), -0.8, 0, 4 * -0.5 / (0.625 + 0.625 + 2),
     std::atan2(1.0, 3.0) * 180 / kPi, 360 - std::acos(-0.6) * 180 / kPi},
    {"inverted square", quad(0, 0, 0, 1, 1, 1, 1, 0), -1, 0, -4, 270, 270},
    // Bow tie: sides 1-2 and 3-0 cross; two of the four triangles are upside down.
    {"bow tie", quad(0, 0, 1, 0, 0, 1, 1, 1), -1 / std::sqrt(2.0), 0, -2, 45, 315},
};

}  // namespace

TEST_CASE("metric sheet: every metric of every element, in any plane, from any corner") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const Row& row : kSheet) {
    CAPTURE(row.element);
    for (std::size_t shift = 0; shift < 4; ++shift)
      for (const double size : {1.0, 1e-6, 1e6}) {
        CAPTURE(shift);
        CAPTURE(size);
        QuadCorners p;
        for (std::size_t i = 0; i < 4; ++i) p[i] = size * (turn * row.corners[(i + shift) % 4]);
        const Vector3d normal = turn * Vector3d::UnitZ();
        CHECK(qmorph::scaled_jacobian(p, normal) == doctest::Approx(row.scaled_jacobian).epsilon(1e-9));
        CHECK(qmorph::eta(p, normal) == doctest::Approx(row.eta).epsilon(1e-9));
        CHECK(qmorph::thesis_metric(p, normal) == doctest::Approx(row.thesis).epsilon(1e-9));
        const auto angles = qmorph::corner_angles_deg(p, normal);
        CHECK(*std::min_element(angles.begin(), angles.end()) == doctest::Approx(row.angle_min).epsilon(1e-9));
        CHECK(*std::max_element(angles.begin(), angles.end()) == doctest::Approx(row.angle_max).epsilon(1e-9));
      }
  }
}

TEST_CASE("metric sheet: triangles and coordinates that are not numbers") {
  const Vector3d z = Vector3d::UnitZ(), a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0.5, std::sqrt(0.75), 0);
  CHECK(qmorph::scaled_jacobian(TriangleCorners{a, b, d}, z) == doctest::Approx(std::sqrt(0.75)));
  CHECK(qmorph::scaled_jacobian(TriangleCorners{a, b, c}, z) == doctest::Approx(std::sqrt(0.5)));
  CHECK(qmorph::scaled_jacobian(TriangleCorners{a, c, b}, z) == doctest::Approx(-1.0));
  CHECK(qmorph::scaled_jacobian(TriangleCorners{a, b, b}, z) == 0);
  const Vector3d nowhere(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  CHECK(qmorph::scaled_jacobian(QuadCorners{a, b, nowhere, c}, z) == -1);
}

TEST_CASE("valence of a boundary node: the limits of the glossary") {
  CHECK(qmorph::boundary_valence(2, 90) == 4);
  CHECK(qmorph::boundary_valence(2, 135) == 4);
  CHECK(qmorph::boundary_valence(3, 135.001) == 4);
  CHECK(qmorph::boundary_valence(3, 224.999) == 4);
  CHECK(qmorph::boundary_valence(4, 225) == 4);
  CHECK(qmorph::boundary_valence(5, 270) == 5);
}
