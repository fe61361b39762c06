// SPDX-License-Identifier: GPL-2.0-or-later
#include "stretch/log_metric.hpp"

#include <algorithm>
#include <cmath>

namespace qmorph::stretch {
namespace {

/// sinh(x) / x.
double sinhc(double x) { return x > 1e-4 ? std::sinh(x) / x : 1 + x * x / 6; }

}  // namespace

double LogMetric::length(const Vec2& v) const {
  const double size = turn.norm(), length2 = v.squaredNorm();
  const double twice_cosine = v.x() * v.x() - v.y() * v.y(), twice_sine = 2 * v.x() * v.y();
  const double square = std::cosh(size) * length2 + sinhc(size) * (turn.x() * twice_cosine + turn.y() * twice_sine);
  // Along the stretch the two terms nearly cancel; less than that is rounding.
  return std::exp(scale / 2) * std::sqrt(std::max(square, std::exp(-size) * length2));
}

Eigen::Matrix2d LogMetric::unstretch() const {
  const double half = turn.norm() / 2, across = 0.5 * sinhc(half);
  Eigen::Matrix2d map;
  map << std::cosh(half) + across * turn.x(), across * turn.y(), across * turn.y(), std::cosh(half) - across * turn.x();
  return std::exp(scale / 2) * map;
}

std::optional<LogMetric> metric_of(const Vec2& side1, const Vec2& side2, const Vec2& side3) {
  double xx = 0, xy = 0, yy = 0;
  for (const Vec2& side : {side1, side2, side3}) {
    xx += 2.0 / 3 * side.x() * side.x();
    xy += 2.0 / 3 * side.x() * side.y();
    yy += 2.0 / 3 * side.y() * side.y();
  }
  // The inverse of this matrix measures all sides alike.
  const Vec2 turn((xx - yy) / 2, xy);
  const double off = turn.norm(), large = (xx + yy) / 2 + off;
  const double area = cross(side1, side2);
  const double small = area * area / (3 * large) * 4;  // the determinant over the other
  if (!(small > 0)) return std::nullopt;
  const double up = std::log(large), down = std::log(small);
  const Vec2 direction = off > 0 ? Vec2(turn / off) : Vec2(Vec2::Zero());
  return LogMetric{-(up + down) / 2, -(up - down) / 2 * direction};
}

}  // namespace qmorph::stretch
