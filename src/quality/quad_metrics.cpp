// SPDX-License-Identifier: GPL-2.0-or-later
// One function for each metric of a single element; the sheet of expected values is
// tests/quality/metric_sheet_test.cpp.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "qmorph/quality.hpp"

namespace qmorph {
namespace {

using Eigen::Vector3d;

constexpr double kTiny = 1e-300;  // keeps 0/0 out; far under any product of two lengths
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kThesisSmallAngleTangent = 0.10510423526567646;  // of 6 degrees [thesis, eq. 2.2]

/// The smallest signed sine over the corners of a polygon.
template <std::size_t N>
double smallest_sine(const std::array<Vector3d, N>& p, const Vector3d& normal) {
  double smallest = 1;
  for (std::size_t i = 0; i < N; ++i) {
    const Vector3d ahead = p[(i + 1) % N] - p[i], behind = p[(i + N - 1) % N] - p[i];
    const double lengths = ahead.norm() * behind.norm();
    const double sine = ahead.cross(behind).dot(normal) / std::max(lengths, kTiny);
    if (std::isnan(sine)) return -1;
    smallest = std::min(smallest, sine);
  }
  return smallest;
}

/// Twice the area of triangle ABC over the sum of its sides' squares.
double area_over_squares(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& normal) {
  const Vector3d ca = a - c, cb = b - c, ab = b - a;
  const double squares = ca.squaredNorm() + ab.squaredNorm() + cb.squaredNorm();
  return ca.cross(cb).dot(normal) / std::max(squares, kTiny);
}

/// Metric of triangle ABC, 1 if it is half of a square cut at its diagonal [thesis, eq. 2.1 and 3.7].
double half_square_metric(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& normal) {
  return 4 * area_over_squares(a, b, c, normal);
}

/// Whether a corner is from 0 to 6 degrees, seen against `normal`; without the cost of the angle itself.
bool has_small_corner(const QuadCorners& p, const Vector3d& normal) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d ahead = p[(i + 1) % 4] - p[i], behind = p[(i + 3) % 4] - p[i];
    const double sine = ahead.cross(behind).dot(normal), cosine = ahead.dot(behind);  // both times the same lengths
    if (cosine >= 0 && sine >= 0 && (sine == 0 || sine < kThesisSmallAngleTangent * cosine)) return true;
  }
  return false;
}

}  // namespace

double scaled_jacobian(const QuadCorners& corners, const Vector3d& normal) { return smallest_sine(corners, normal); }

double scaled_jacobian(const TriangleCorners& corners, const Vector3d& normal) {
  return smallest_sine(corners, normal);
}

std::array<double, 4> corner_angles_deg(const QuadCorners& p, const Vector3d& normal) {
  std::array<double, 4> angles{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d ahead = p[(i + 1) % 4] - p[i], behind = p[(i + 3) % 4] - p[i];
    // + 0.0: an edge without length may give -0, of which atan2 makes 180 degrees
    const double angle = std::atan2(ahead.cross(behind).dot(normal), ahead.dot(behind) + 0.0) * kDegrees;
    angles[i] = angle < 0 ? angle + 360 : angle;
  }
  return angles;
}

double eta(const QuadCorners& corners, const Vector3d& normal) {
  double worst = 0;
  for (const double angle : corner_angles_deg(corners, normal)) worst = std::max(worst, std::abs(angle - 90));
  return std::max(0.0, 1 - worst / 90);
}

double thesis_metric(const QuadCorners& p, const Vector3d& normal) {
  const std::array<double, 4> metrics{
      half_square_metric(p[0], p[1], p[2], normal), half_square_metric(p[0], p[2], p[3], normal),
      half_square_metric(p[0], p[1], p[3], normal), half_square_metric(p[1], p[2], p[3], normal)};
  const auto inverted = std::count_if(metrics.begin(), metrics.end(), [](double m) { return m < 0; });
  double penalty = 0;
  if (inverted >= 2) {
    penalty = double(inverted - 1);
  } else if (has_small_corner(p, normal)) {
    penalty = 1;
  }
  return *std::min_element(metrics.begin(), metrics.end()) - penalty;
}

double thesis_metric(const TriangleCorners& p, const Vector3d& normal) {
  return 2 * std::numbers::sqrt3 * area_over_squares(p[0], p[1], p[2], normal);
}

int boundary_valence(int edges, double angle_deg) {
  if (angle_deg <= 135) return edges + 2;
  return angle_deg < 225 ? edges + 1 : edges;
}

}  // namespace qmorph
