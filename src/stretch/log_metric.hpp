// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Metrics of a plane by their logarithms, in which means are taken [Arsigny06].

#include <Eigen/Core>
#include <optional>

#include "geometry/vec2.hpp"

namespace qmorph::stretch {

/// The logarithm of a metric: of its mean scale, and of how it is stretched, as a vector with twice the angle of the
/// direction in which lengths are largest, so that opposite directions are the same and those at a right angle cancel
/// each other. A linear space: sums and multiples are those of matrices.
struct LogMetric {
  double scale = 0;
  Vec2 turn = Vec2::Zero();

  LogMetric& operator+=(const LogMetric& other) {
    scale += other.scale, turn += other.turn;
    return *this;
  }
  LogMetric operator*(double factor) const { return {factor * scale, factor * turn}; }

  /// How many times longer than in the direction across the longest lengths are that measure the same.
  double ratio() const { return std::exp(turn.norm()); }
  /// Length of a vector.
  double length(const Vec2& v) const;
  /// The map after which lengths are what the metric measures.
  Eigen::Matrix2d unstretch() const;
};

/// The metric in which the sides of a triangle, given as vectors around it, are all 1. Nothing of one without area.
std::optional<LogMetric> metric_of(const Vec2& side1, const Vec2& side2, const Vec2& side3);

/// Whether a triangle, given the sum of its squared sides and twice its area, is stretched by more than the ratio.
inline bool is_stretched_by(double ratio, double squares, double twice_area) {
  // The trace, and the determinant times four, of what has the squared stretches for eigenvalues.
  const double least = (ratio + 1 / ratio) * (ratio + 1 / ratio);
  return squares * squares > 3 * least * twice_area * twice_area;
}

}  // namespace qmorph::stretch
