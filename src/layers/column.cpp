// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/column.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace qmorph::layers {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi, kRight = kPi / 2, kDegree = kPi / 180;

/// Heights of nearly isotropic cells on top of one another do not differ by a larger factor (see kJump).
constexpr double kNearJump = 2.2;
/// By how much cells near to isotropic may be off what is expected, and the column's middle line off its direction.
constexpr double kNearMisfit = 20 * kDegree;
/// Cells higher than so many times their length belong to other columns.
constexpr double kLeastAspect = 0.5;

Vector3d middle(const Sides& sides, Index c) { return (sides.point(sides.from(c)) + sides.point(sides.to(c))) / 2; }

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Where side c begins.
double corner(const Sides& sides, Index c) {
  const Vector3d& p = sides.point(sides.from(c));
  return angle_between(sides.point(sides.to(c)) - p, sides.point(sides.apex(c)) - p);
}

/// Between the wall side c and the one before it.
double wall_angle(const Sides& sides, Index c) {
  double sum = corner(sides, c);
  for (c = Sides::previous(c); !sides.is_wall(c); c = Sides::previous(c)) {
    c = sides.opposite(c);
    sum += corner(sides, c);
  }
  return sum;
}

/// How far x is outside the range between two numbers.
double outside(double x, double a, double b) { return std::max({0.0, std::min(a, b) - x, x - std::max(a, b)}); }

/// How far the middle line turns.
double turn(const Sides& sides, const Column& column, const Cell& cell) {
  constexpr std::size_t kLookBack = 2;
  if (column.feet.size() < 2) return 0;
  const Vector3d& foot = column.feet.back();
  const Vector3d& from = column.feet[column.feet.size() - 1 - std::min(kLookBack, column.feet.size() - 1)];
  return angle_between(foot - from, middle(sides, cell.top) - foot);
}

bool differ_by_less(double a, double b, double factor) { return a <= factor * b && b <= factor * a; }

}  // namespace

Column column_on_wall(const Sides& sides, Index wall) {
  constexpr double kLeast = 30 * kDegree, kMost = 165 * kDegree;
  const auto bisector = [&](Index c) { return std::clamp(wall_angle(sides, c) / 2, kLeast, kMost); };
  Column column{.base = wall, .straight = {bisector(wall), bisector(sides.next_wall(wall))}};
  column.feet.push_back(middle(sides, wall));
  return column;
}

Column column_above(const Sides& sides, const Cell& cell) {
  Column column{.base = sides.opposite(cell.top),
                .height = cell.height,
                .straight = {kPi - cell.angles[3], kPi - cell.angles[2]}};
  column.feet = {middle(sides, cell.base), middle(sides, cell.top)};
  return column;
}

Column column_below(const Sides& sides, const Cell& cell) {
  Column column{.base = sides.opposite(cell.base),
                .height = cell.height,
                .straight = {kPi - cell.angles[1], kPi - cell.angles[0]}};
  column.feet = {middle(sides, cell.top), middle(sides, cell.base)};
  return column;
}

Column column_from_tip(const Sides& sides, Index outer) {
  const Vector3d &tip = sides.point(sides.apex(outer)), foot = middle(sides, outer);
  Column column{.base = sides.opposite(outer),
                .height = (foot - tip).norm(),
                .straight = {kPi - corner(sides, Sides::next(outer)), kPi - corner(sides, outer)}};
  column.feet = {tip, foot};
  return column;
}

void grow(const Sides& sides, Column& column, Index number, const Cell& cell) {
  column.base = sides.opposite(cell.top);
  column.cells.push_back(number);
  column.height = cell.height;
  column.straight = {kPi - cell.angles[3], kPi - cell.angles[2]};
  column.feet.push_back(middle(sides, cell.top));
}

std::optional<Cell> best_cell(const Cells& cells, const Column& column) {
  const Sides& sides = cells.sides();
  std::optional<Cell> best;
  if (column.base == kNone || cells.is_taken(column.base / 3)) return best;
  for (Index diagonal : {Sides::next(column.base), Sides::previous(column.base)}) {
    if (sides.is_wall(diagonal) || cells.is_taken(sides.opposite(diagonal) / 3)) continue;
    const Cell cell = make_cell(sides, column.base, diagonal);
    if (!is_convex(cell)) continue;
    if (!best || misfit(sides, cell, column) < misfit(sides, *best, column)) best = cell;
  }
  return best;
}

double misfit(const Sides& sides, const Cell& cell, const Column& column) {
  double worst = 0;
  const auto is_along_wall = [&](Index lateral) {
    return sides.is_wall(lateral) && !sides.is_wall(cell.top) && sides.length(lateral) < sides.length(cell.base);
  };
  for (std::size_t i = 0; i < 2; ++i) {
    if (!is_along_wall(i == 0 ? cell.left : cell.right))
      worst = std::max(worst, outside(cell.angles[i], kRight, column.straight[i]));
    worst = std::max(worst, outside(cell.angles[3 - i], kRight, kPi - cell.angles[i]));
  }
  return worst;
}

bool goes_on(const Sides& sides, const Column& column, const Cell& cell, bool is_beside) {
  const double off = misfit(sides, cell, column);
  if (cell.aspect() >= kNearIsotropic)
    return off <= (is_beside ? kMisfitBeside : kMisfit) && differ_by_less(cell.height, column.height, kJump);
  return cell.aspect() >= kLeastAspect && off <= kNearMisfit && turn(sides, column, cell) <= kNearMisfit &&
         differ_by_less(cell.height, column.height, kNearJump);
}

}  // namespace qmorph::layers
