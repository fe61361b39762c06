// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <utility>

#include "geometry/vec2.hpp"

namespace qmorph {

/// The points p with normal . p = offset.
struct Line {
  Vec2 normal = Vec2::UnitX();
  double offset = 0;
  double distance(const Vec2& p) const { return normal.dot(p) - offset; }
};

/// The best of some lines that leave about this share of the points behind them: short inside the outline, crossing it
/// rarely and squarely. `outline` has the segments of the outline in any order.
Line choose_cutting_line(std::span<const Vec2> points, std::span<const std::pair<Vec2, Vec2>> outline, double share);

}  // namespace qmorph
