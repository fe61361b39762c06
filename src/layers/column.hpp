// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A pile of cells, each on top of the one before, and which cell may come next.

#include <numbers>

#include "layers/cells.hpp"

namespace qmorph::layers {

struct Column {
  Index base = kNone;          ///< of the next cell; a wall's other side if there is none
  std::vector<Index> cells{};  ///< so far
  double height = 0;           ///< of the last one; 0 before the first
  /// Angles at the two ends of the base with which the sides of the last cell go on straight.
  std::array<double, 2> straight{};
  std::vector<Eigen::Vector3d> feet{};  ///< middles of the bases
};

/// Of the first cell, sides are expected between the perpendicular and, where the wall has a corner, its bisector.
Column column_on_wall(const Sides& sides, Index wall);
/// A column that goes on from the top of a cell, or from its base downwards.
Column column_above(const Sides& sides, const Cell& cell);
Column column_below(const Sides& sides, const Cell& cell);
/// The triangle is a fan's, with the tip across `outer`.
Column column_from_tip(const Sides& sides, Index outer);

/// Puts `cell` on top.
void grow(const Sides& sides, Column& column, Index number, const Cell& cell);

/// Of the two cells that may come next, the one that fits better; nothing if there is none.
std::optional<Cell> best_cell(const Cells& cells, const Column& column);

/// By how much the worst corner of a cell is off what the column expects, in radians. Where the column grows along a
/// wall, as at the curve on which a layer ends, the angle to it is what it is; but not in a single row between walls,
/// nor where that side is longer than the base.
double misfit(const Sides& sides, const Cell& cell, const Column& column);

/// True if a cell goes on with the column. One that is not much longer than high could be two triangles of any mesh,
/// and must look more like the one below. Beside a cell that is taken, less is asked for.
bool goes_on(const Sides& sides, const Column& column, const Cell& cell, bool is_beside);

/// Cells that are not longer than that times their height are near to isotropic.
inline constexpr double kNearIsotropic = 2;
/// Heights of cells on top of one another do not differ by a larger factor.
inline constexpr double kJump = 4;
/// By how much a corner may be off what is expected, and how much beside a cell that is taken.
inline constexpr double kMisfit = 30 * std::numbers::pi / 180, kMisfitBeside = 40 * std::numbers::pi / 180;

}  // namespace qmorph::layers
