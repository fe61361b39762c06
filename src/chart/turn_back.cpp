// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/turn_back.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "kernel/sort_unique.hpp"

namespace qmorph::chart {
namespace {

constexpr int kSweeps = 12;  // those that succeed take one to three, seldom nine
constexpr int kDirections = 8;
constexpr double kLeastSine = 0.02;
/// With more than this share of the triangles turned over, plus a few, the fault is not local.
constexpr double kShare = 0.02;
constexpr std::size_t kSome = 8;

class Turning {
 public:
  Turning(const space::Background& surface, std::vector<Vec2>& points) : surface_(surface), points_(points) {
    for (int turn = 0; turn < kDirections; ++turn)
      directions_[turn] = rotated(Vec2(1, 0), 2 * std::numbers::pi * turn / kDirections);
  }

  bool run() {
    std::vector<Index> bad;
    for (Index t = 0; t < surface_.triangles(); ++t)
      if (sine(t) < kLeastSine / 10) bad.push_back(t);
    if (double(bad.size()) > double(kSome) + kShare * double(surface_.triangles())) return false;
    for (int sweep = 0; sweep < kSweeps && !bad.empty(); ++sweep) {
      std::vector<Index> corners;
      for (Index t : bad)
        for (Index i = 0; i < 3; ++i) corners.push_back(3 * t + i);
      bool moved = false;
      for (Index corner : corners) moved = raise(corner) || moved;
      std::vector<Index> near;
      for (Index corner : corners) surface_.for_fan(corner, kNone, [&](Index around) { near.push_back(around / 3); });
      sort_unique(near);
      std::vector<Index> left;
      for (Index t : near)
        if (sine(t) < kLeastSine) left.push_back(t);
      if (!moved && left == bad) break;  // nor will another sweep move anything
      bad = std::move(left);
    }
    return true;
  }

  std::size_t work() const { return looks_; }

 private:
  double sine(Index t) const {
    const auto& [a, b, c] = surface_.corners(t);
    return std::min({corner_sine(points_[a], points_[b], points_[c]), corner_sine(points_[b], points_[c], points_[a]),
                     corner_sine(points_[c], points_[a], points_[b])});
  }

  /// The smallest one; anything below `enough` if it is not above that.
  double sine_around(Index corner, double enough = -1) const {
    double least = std::numeric_limits<double>::infinity();
    surface_.for_fan(corner, kNone, [&](Index around) {
      if (!(least > enough)) return;
      least = std::min(least, sine(around / 3));
      ++looks_;
    });
    return least;
  }

  /// Compass search; steps are shares of the longest side around. True if it has moved the point.
  bool raise(Index corner) {
    Vec2& p = points_[surface_.corners(corner / 3)[corner % 3]];
    double longest = 0;
    surface_.for_fan(corner, kNone, [&](Index around) {
      for (Index v : surface_.corners(around / 3)) longest = std::max(longest, (points_[v] - p).norm());
    });
    double best = sine_around(corner);
    constexpr double kLargest = 0.25, kSmallest = 1e-4;
    constexpr int kMostSteps = 40;
    const Vec2 start = p;
    double step = kLargest;
    for (int k = 0; k < kMostSteps && step > kSmallest; ++k) {
      const Vec2 from = p;
      Vec2 to = from;
      for (int turn = 0; turn < kDirections; ++turn) {
        p = from + step * longest * directions_[turn];
        const double here = sine_around(corner, best);
        if (here > best) best = here, to = p;
      }
      p = to;
      if (to == from) step /= 2;
    }
    return p != start;
  }

  const space::Background& surface_;
  std::vector<Vec2>& points_;
  std::array<Vec2, kDirections> directions_;
  mutable std::size_t looks_ = 0;  ///< at triangles
};

}  // namespace

bool turn_back(const space::Background& surface, std::vector<Vec2>& points, std::size_t& work) {
  Turning turning(surface, points);
  const bool has_turned = turning.run();
  work += turning.work();
  return has_turned;
}

}  // namespace qmorph::chart
