// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/strips.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>

#include "layers/remnants.hpp"
#include "layers/walls.hpp"

namespace qmorph::layers {
namespace {

constexpr double kRight = std::numbers::pi / 2, kDegree = kRight / 90;
/// Cells begin at this length over height: more than in grids of 2 to 1, which are left to the front.
constexpr double kLeastLong = 2.25;
/// Cells of a grid that leans, as on a swept wing, are off 90 degrees by this at most, and so long; triangles are thin
/// there because they lean.
constexpr double kLeaning = 50 * kDegree, kLeaningLong = 5;
/// The other way to pair is worse by this, or the grid goes from wall to wall.
constexpr double kMuchWorse = 20 * kDegree;

/// The shortest side of a free triangle that may be half of a cell much longer than high; kNone of another one.
Index short_side(const Cells& cells, Index t) {
  const Sides& sides = cells.sides();
  if (cells.is_taken(t)) return kNone;
  std::array<Eigen::Vector3d, 3> along;
  for (Index i = 0; i < 3; ++i) along[i] = sides.point(sides.to(3 * t + i)) - sides.point(sides.from(3 * t + i));
  Index shortest = 0, longest = 0;
  for (Index i = 1; i < 3; ++i) {
    if (along[i].squaredNorm() < along[shortest].squaredNorm()) shortest = i;
    if (along[i].squaredNorm() > along[longest].squaredNorm()) longest = i;
  }
  constexpr double kThin = kLeastLong + 1 / kLeastLong;  // of a rectangle's half
  if (!(along[longest].squaredNorm() >= kThin * along[0].cross(along[1]).norm())) return kNone;
  const auto off_perpendicular = [&](Index other) {
    return std::abs(std::atan2(along[shortest].cross(along[other]).norm(), along[shortest].dot(along[other])) - kRight);
  };
  return std::min(off_perpendicular((shortest + 1) % 3), off_perpendicular((shortest + 2) % 3)) <= kLeaning
             ? 3 * t + shortest
             : kNone;
}

/// By how much the worst corner is off 90 degrees.
double skew_of(const Cell& cell) {
  double worst = 0;
  for (double angle : cell.angles) worst = std::max(worst, std::abs(angle - kRight));
  return worst;
}

/// One of the two ways to make a column of triangles into pairs.
struct Pairing {
  std::vector<Cell> cells;   ///< those that are long and not too askew
  double skew = 0;           ///< the mean of all
  std::size_t compared = 0;  ///< how many that is

  void add(double off) { skew += (off - skew) / double(++compared); }
  /// Leaves out cells that lean, unless the column as a whole does, and is no better the other way.
  void keep_upright(const Pairing& other, bool is_from_wall_to_wall) {
    const bool is_whole = is_from_wall_to_wall && compared >= kRow && cells.size() == compared;
    if (is_whole || (other.compared > 0 && skew + kMuchWorse < other.skew)) return;
    std::erase_if(cells, [](const Cell& cell) { return skew_of(cell) > kMisfit; });
  }

  /// By how much rows bend where they go on beside it, in the mean; nothing if no cell has a neighbour.
  std::optional<double> bend(const Cells& taken) const {
    double sum = 0;
    std::size_t count = 0;
    // The corners at the two ends of a lateral side, and the angles of the cell beyond: together straight.
    const auto look = [&](Index side, double at_start, double at_end) {
      const Index number = taken.beside(side);
      if (number == kNone) return;
      const Cell& other = taken[number];
      const bool is_left = other.left == taken.sides().opposite(side);
      sum += std::abs(at_start + other.angles[is_left ? 0 : 2] - 2 * kRight);
      sum += std::abs(at_end + other.angles[is_left ? 3 : 1] - 2 * kRight);
      count += 2;
    };
    for (const Cell& cell : cells) {
      look(cell.right, cell.angles[1], cell.angles[2]);
      look(cell.left, cell.angles[3], cell.angles[0]);
    }
    if (count == 0) return std::nullopt;
    return sum / double(count);
  }
};

class Strips {
 public:
  Strips(Cells& cells, const std::vector<Index>& thin)
      : cells_(cells), sides_(cells.sides()), short_(sides_.count() / 3, kNone), path_of_(short_.size(), kNone) {
    for (Index t : thin) short_[t] = short_side(cells_, t);
    for (Index t : thin)
      if (short_[t] != kNone && path_of_[t] == kNone) walk(t);
  }

  void take() {
    const Index first = Index(cells_.size());
    std::deque<Index> undecided;
    for (Index p = 0; p < paths_.size(); ++p) {
      const auto& [one, two] = paths_[p].pairings;
      const bool is_askew = std::abs(one.skew - two.skew) > kClearSkew && one.compared > 0 && two.compared > 0;
      if (is_askew)
        take_pairs(p, one.skew < two.skew ? one : two);
      else if (one.cells.size() != two.cells.size())
        take_pairs(p, one.cells.size() > two.cells.size() ? one : two);
      else
        undecided.push_back(p);
    }
    // Neighbours of columns that are decided come first; where there are none, the less skew way is taken.
    for (; !undecided.empty(); undecided.pop_front()) {
      queue_.push_back(undecided.front());
      while (!queue_.empty()) {
        const Index p = queue_.front();
        queue_.pop_front();
        if (paths_[p].is_decided) continue;
        const auto& [one, two] = paths_[p].pairings;
        const auto bend_one = one.bend(cells_), bend_two = two.bend(cells_);
        const bool is_two = bend_one && bend_two ? *bend_two < *bend_one : two.skew < one.skew;
        take_pairs(p, is_two ? two : one);
      }
    }
    drop_lone_cells(first);
    march_on(first);
  }

 private:
  static constexpr double kClearSkew = 8 * kDegree;

  struct Path {
    std::array<Pairing, 2> pairings;
    bool is_decided = false;
  };

  /// From a triangle across one of its long sides, to another one that is about as high.
  bool is_link(Index c) const {
    if (c == short_[c / 3] || sides_.is_wall(c)) return false;
    const Index other = sides_.opposite(c), its_short = short_[other / 3];
    return its_short != kNone && other != its_short && are_alike(short_[c / 3], its_short);
  }

  /// In length, as sides of cells on top of one another are.
  bool are_alike(Index c, Index d) const {
    const auto squared = [&](Index side) {
      return (sides_.point(sides_.to(side)) - sides_.point(sides_.from(side))).squaredNorm();
    };
    return squared(c) <= kJump * kJump * squared(d) && squared(d) <= kJump * kJump * squared(c);
  }

  /// Not to a wall, nor to a cell.
  bool is_open(Index c) const { return !sides_.is_wall(c) && !cells_.is_taken(sides_.opposite(c) / 3); }

  Index other_long_side(Index c) const {
    const Index next = Sides::next(c);
    return next == short_[c / 3] ? Sides::next(next) : next;
  }

  /// Finds the column that triangle t is part of.
  void walk(Index t) {
    Index c = Sides::next(short_[t]);  // back to where it begins, or once round
    while (is_link(c)) {
      c = other_long_side(sides_.opposite(c));
      if (c / 3 == t) break;
    }
    Path path;
    // Beyond the ends, pairs are compared, but not made.
    if (is_open(c) && !is_link(c)) path.pairings[1].add(skew_of(make_cell(sides_, other_long_side(c), c)));
    const Index begin = c / 3;
    bool is_from_wall_to_wall = false;
    const bool is_at_wall = sides_.is_wall(c);
    // `c` is the long side of a triangle through which the column enters.
    for (std::size_t i = 0;; ++i) {
      path_of_[c / 3] = Index(paths_.size());
      const Index diagonal = other_long_side(c);
      is_from_wall_to_wall = is_at_wall && sides_.is_wall(diagonal) && i % 2 == 1;
      if (!is_open(diagonal)) break;
      const Cell cell = make_cell(sides_, c, diagonal);
      const double off = skew_of(cell);
      path.pairings[i % 2].add(off);
      if (!is_link(diagonal)) break;
      if (off <= kLeaning && cell.aspect() >= (off <= kMisfit ? kNearIsotropic : kLeaningLong))
        path.pairings[i % 2].cells.push_back(cell);
      c = sides_.opposite(diagonal);
      if (c / 3 == begin) break;
    }
    auto& [one, two] = path.pairings;
    one.keep_upright(two, is_from_wall_to_wall);
    two.keep_upright(one, false);
    paths_.push_back(std::move(path));
  }

  void take_pairs(Index p, const Pairing& pairing) {
    paths_[p].is_decided = true;
    for (const Cell& cell : pairing.cells) {
      if (cells_.is_taken(cell.triangles[0]) || cells_.is_taken(cell.triangles[1])) continue;
      cells_.take(cell);
      for (Index side : {cell.left, cell.right}) {
        if (sides_.is_wall(side)) continue;
        const Index beside = path_of_[sides_.opposite(side) / 3];
        if (beside != kNone && !paths_[beside].is_decided) queue_.push_back(beside);
      }
    }
  }

  void drop_lone_cells(Index first) {
    std::vector<Index> lone;
    for (Index i = first; i < cells_.size(); ++i)
      if (cells_.row_length(i, 0, kRow) < kRow) lone.push_back(i);
    for (Index i : lone) cells_.drop(i);
  }

  void march_on(Index first) {
    std::vector<Column> columns;
    for (Index i = first; i < cells_.size(); ++i) {
      if (!cells_.is_live(i)) continue;
      columns.push_back(column_above(sides_, cells_[i]));
      columns.push_back(column_below(sides_, cells_[i]));
    }
    std::erase_if(columns,
                  [&](const Column& column) { return column.base == kNone || cells_.is_taken(column.base / 3); });
    march(cells_, columns);
  }

  Cells& cells_;
  const Sides& sides_;
  std::vector<Index> short_, path_of_;  ///< by triangle
  std::vector<Path> paths_;
  std::deque<Index> queue_;
};

/// Takes a set of free triangles that hang together, by cells that go on from the ones around; all, or none.
class Gap {
 public:
  explicit Gap(Cells& cells) : cells_(cells), sides_(cells.sides()) {}

  void fill(const std::vector<Index>& triangles) {
    const Index first = Index(cells_.size());
    bases_.clear();
    for (Index t : triangles)
      for (Index c = 3 * t; c < 3 * t + 3; ++c)
        if (!sides_.is_wall(c) && cells_.is_taken(sides_.opposite(c) / 3)) bases_.push_back(c);
    if (take_all() && 2 * (cells_.size() - first) == triangles.size()) return;
    for (Index i = first; i < cells_.size(); ++i) cells_.drop(i);
  }

 private:
  bool take_all() {
    for (std::size_t next = 0; next < bases_.size(); ++next) {
      const Column column{.base = bases_[next], .straight = {kRight, kRight}};
      if (cells_.is_taken(column.base / 3)) continue;
      const auto cell = best_cell(cells_, column);
      if (!cell || misfit(sides_, *cell, column) > kMisfit) return false;
      cells_.take(*cell);
      for (Index side : {cell->right, cell->top, cell->left})
        if (!sides_.is_wall(side)) bases_.push_back(sides_.opposite(side));
    }
    return true;
  }

  Cells& cells_;
  const Sides& sides_;
  std::vector<Index> bases_;
};

}  // namespace

void take_strips(Cells& cells, const std::vector<Index>& thin) { Strips(cells, thin).take(); }

void fill_gaps(Cells& cells) {
  const Parts parts = free_parts(cells);
  std::vector<std::vector<Index>> triangles(parts.sizes.size());
  for (Index t = 0; t < parts.part_of.size(); ++t)
    if (parts.part_of[t] != kNone) triangles[parts.part_of[t]].push_back(t);
  Gap gap(cells);
  for (const auto& part : triangles) gap.fill(part);
}

}  // namespace qmorph::layers
