// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parts/cutting_line.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/cut_cost.hpp"

namespace qmorph {
namespace {

constexpr int kDirections = 12;
constexpr double kShifts[] = {0, -0.04, 0.04, -0.08, 0.08};  ///< of the share

/// The length of the line inside the outline, and its ends. `extent`: of all points, across the line.
double cost_of(const Line& line, std::span<const std::pair<Vec2, Vec2>> outline, double extent) {
  const Vec2 along = left_of(line.normal);
  std::vector<double> ends;
  double cost = 0;
  for (const auto& [a, b] : outline) {
    const double da = line.distance(a), db = line.distance(b);
    if ((da < 0) == (db < 0)) continue;
    const Vec2 edge = b - a;
    ends.push_back(along.dot(a + edge * (da / (da - db))));
    const double sine = std::abs(da - db) / edge.norm();
    cost += extent * cost_of_cut_end(sine);
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) cost += ends[i + 1] - ends[i];
  return cost;
}

}  // namespace

Line choose_cutting_line(std::span<const Vec2> points, std::span<const std::pair<Vec2, Vec2>> outline, double share) {
  Line best;
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> offsets(points.size());
  for (int i = 0; i < kDirections; ++i) {
    const Vec2 normal = rotated(Vec2::UnitX(), std::numbers::pi * i / kDirections);
    for (std::size_t k = 0; k < points.size(); ++k) offsets[k] = normal.dot(points[k]);
    std::sort(offsets.begin(), offsets.end());
    for (double shift : kShifts) {
      const double rank = std::clamp(share + shift, 0.0, 1.0) * double(points.size() - 1);
      const Line line{normal, offsets[std::size_t(rank)]};
      const double cost = cost_of(line, outline, offsets.back() - offsets.front());
      if (cost < least) best = line, least = cost;
    }
  }
  return best;
}

}  // namespace qmorph
