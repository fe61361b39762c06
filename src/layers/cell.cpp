// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/cell.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace qmorph::layers {
namespace {

using Eigen::Vector3d;

struct Corner {
  Vector3d ahead, behind;
  double twice_area() const { return ahead.cross(behind).norm(); }
  double angle() const { return std::atan2(twice_area(), ahead.dot(behind)); }
};

/// Where side c begins.
Corner corner_at(const Sides& sides, Index c) {
  const Vector3d& p = sides.point(sides.from(c));
  return {sides.point(sides.to(c)) - p, sides.point(sides.apex(c)) - p};
}

}  // namespace

bool is_convex(const Cell& cell) {
  constexpr double kSharpest = 4 * std::numbers::pi / 180;
  const auto [least, most] = std::minmax_element(cell.angles.begin(), cell.angles.end());
  return *least >= kSharpest && *most <= std::numbers::pi - kSharpest;
}

Cell make_cell(const Sides& sides, Index base, Index diagonal) {
  const Index across = sides.opposite(diagonal);
  Cell cell;
  cell.base = base;
  cell.triangles = {base / 3, across / 3};
  if (diagonal == Sides::next(base)) {
    cell.left = Sides::next(diagonal);
    cell.right = Sides::next(across);
    cell.top = Sides::previous(across);
  } else {
    cell.right = Sides::next(base);
    cell.top = Sides::next(across);
    cell.left = Sides::previous(across);
  }
  cell.nodes = {sides.from(base), sides.to(base), sides.from(cell.top), sides.to(cell.top)};

  // Two corners lie in one triangle each, the others are cut by the diagonal.
  const auto set_angle = [&](Index node, double angle) {
    for (std::size_t i = 0; i < 4; ++i)
      if (cell.nodes[i] == node) cell.angles[i] = angle;
  };
  set_angle(sides.from(diagonal), corner_at(sides, diagonal).angle() + corner_at(sides, Sides::next(across)).angle());
  set_angle(sides.to(diagonal), corner_at(sides, Sides::next(diagonal)).angle() + corner_at(sides, across).angle());
  set_angle(sides.apex(diagonal), corner_at(sides, Sides::previous(diagonal)).angle());
  set_angle(sides.apex(across), corner_at(sides, Sides::previous(across)).angle());
  const double area = (corner_at(sides, base).twice_area() + corner_at(sides, across).twice_area()) / 2;
  cell.length = (sides.length(base) + sides.length(cell.top)) / 2;
  cell.height = area / cell.length;
  return cell;
}

}  // namespace qmorph::layers
