// SPDX-License-Identifier: GPL-2.0-or-later
#include "smoothing/distortion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace qmorph::smoothing {
namespace {

/// Twice the area of a triangle over the sum of its sides' squares; 0 where all corners are one point.
double area_over_squares(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double squares = (a - c).squaredNorm() + (b - c).squaredNorm() + (b - a).squaredNorm();
  return squares > 0 ? cross(a - c, b - c) / squares : 0;
}

double half_square(const Vec2& a, const Vec2& b, const Vec2& c) { return 4 * area_over_squares(a, b, c); }

bool is_sharp(const Vec2& at, const Vec2& next, const Vec2& previous) {
  static const double kTangent = std::tan(6 * std::numbers::pi / 180);
  const Vec2 a = next - at, b = previous - at;
  const double area = cross(a, b), product = a.dot(b);
  return area >= 0 && product > 0 && area < kTangent * product;
}

}  // namespace

double distortion(const kernel::Mesh& mesh, Index f, double coincidence) {
  const Index h = mesh.half_edge(f);
  const Vec2 &a = mesh.point(mesh.origin(h)), &b = mesh.point(mesh.target(h)),
             &c = mesh.point(mesh.target(mesh.next(h)));
  if (mesh.degree(f) == 3) return 2 * std::numbers::sqrt3 * area_over_squares(a, b, c);
  const Vec2& d = mesh.point(mesh.origin(mesh.prev(h)));
  const double metrics[] = {half_square(a, b, c), half_square(a, c, d), half_square(a, b, d), half_square(b, c, d)};
  const auto inverted = std::count_if(std::begin(metrics), std::end(metrics), [](double m) { return m < 0; });
  double penalty = 0;
  if (inverted >= 2) {
    penalty = double(inverted - 1);
  } else {
    const double sides[] = {(b - a).squaredNorm(), (c - b).squaredNorm(), (d - c).squaredNorm(), (a - d).squaredNorm()};
    const double nearest =
        std::min({*std::min_element(sides, sides + 4), (c - a).squaredNorm(), (d - b).squaredNorm()});
    const double longest = *std::max_element(sides, sides + 4);
    if (nearest < coincidence * coincidence * longest || is_sharp(a, b, d) || is_sharp(b, c, a) || is_sharp(c, d, b) ||
        is_sharp(d, a, c))
      penalty = 1;
  }
  return *std::min_element(std::begin(metrics), std::end(metrics)) - penalty;
}

double smallest_distortion_around(const kernel::Mesh& mesh, Index v, double coincidence) {
  double smallest = 1;
  for (Index h : mesh.around(v))
    if (mesh.face(h) != kNone) smallest = std::min(smallest, distortion(mesh, mesh.face(h), coincidence));
  return smallest;
}

}  // namespace qmorph::smoothing
