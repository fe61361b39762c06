// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Triangles with the shapes that they have in space, and how those got to their places in a chart.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <vector>

#include "geometry/vec2.hpp"
#include "space/background.hpp"

namespace qmorph::chart {

using Complex = std::complex<double>;

/// A triangle is taken to be at least this times as high as long: without height it has no direction.
constexpr double kLeastHeight = 1e-3;

/// The usual product: std::complex takes care of numbers that are not finite, too.
inline Complex product(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// A triangle in a plane of its own: corners at 0, (base, 0) and `tip`.
struct Shape {
  double base = 0;
  Complex tip;
  Complex corner(int i) const { return i == 0 ? Complex(0) : i == 1 ? Complex(base) : tip; }
  Complex side(int i) const { return corner((i + 1) % 3) - corner(i); }
  double area() const { return 0.5 * base * tip.imag(); }
  /// Cotangent of the corner across side i.
  double cotangent(int i) const {
    const Complex at = corner((i + 2) % 3), to = corner(i) - at, other = corner((i + 1) % 3) - at;
    return product(std::conj(to), other).real() / (2 * area());
  }
};

inline Shape shape_of(const space::Background& surface, Index t) {
  const Eigen::Vector3d &a = surface.corner(t, 0), &b = surface.corner(t, 1), &c = surface.corner(t, 2);
  const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm(), longest = std::max({ab, bc, ca});
  Shape shape;
  shape.base = std::max(ab, kLeastHeight * longest);
  const double along = ab > 0 ? (b - a).dot(c - a) / ab : 0;
  const double height = ab > 0 ? (b - a).cross(c - a).norm() / ab : 0;
  shape.tip = {along, std::max(height, kLeastHeight * longest)};
  return shape;
}

/// How a triangle got to its place: z -> a z + b conj(z).
struct Map {
  Complex a, b;
  double larger() const { return size(a) + size(b); }
  double smaller() const { return size(a) - size(b); }  ///< negative if it is turned over
  Complex rotation() const { return std::norm(a) > 0 ? a / size(a) : Complex(1); }
  /// std::abs() takes care of numbers that are too large or too small to be squared, which takes most of the time.
  static double size(const Complex& z) { return std::sqrt(std::norm(z)); }
};

inline Map map_of(const Shape& shape, const Complex& p, const Complex& q, const Complex& r) {
  const Complex along = (q - p) / shape.base;
  const Complex up = ((r - p) - along * shape.tip.real()) / shape.tip.imag(), across(up.imag(), -up.real());
  return {0.5 * (along + across), 0.5 * (along - across)};
}

inline Map map_of(const space::Background& surface, const Shape& shape, Index t, const std::vector<Vec2>& points) {
  const auto complex_of = [&](int i) {
    const Vec2& p = points[surface.corners(t)[i]];
    return Complex(p.x(), p.y());
  };
  return map_of(shape, complex_of(0), complex_of(1), complex_of(2));
}

}  // namespace qmorph::chart
