// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/turn_back.hpp"

#include <algorithm>
#include <limits>

#include "kernel/sort_unique.hpp"

namespace qmorph::chart {
namespace {

constexpr int kSweeps = 30;
constexpr double kLeastSine = 0.02;
/// With more than this share of the triangles turned over, plus a few, the fault is not local.
constexpr double kShare = 0.02;
constexpr std::size_t kSome = 8;

class Turning {
 public:
  Turning(const space::Background& surface, std::vector<Vec2>& points) : surface_(surface), points_(points) {}

  bool run() {
    std::vector<Index> bad;
    for (Index t = 0; t < surface_.triangles(); ++t)
      if (sine(t) < kLeastSine / 10) bad.push_back(t);
    if (double(bad.size()) > double(kSome) + kShare * double(surface_.triangles())) return false;
    for (int sweep = 0; sweep < kSweeps && !bad.empty(); ++sweep) {
      std::vector<Index> corners;
      for (Index t : bad)
        for (Index i = 0; i < 3; ++i) corners.push_back(3 * t + i);
      for (Index corner : corners) raise(corner);
      std::vector<Index> near;
      for (Index corner : corners) surface_.for_fan(corner, kNone, [&](Index around) { near.push_back(around / 3); });
      sort_unique(near);
      bad.clear();
      for (Index t : near)
        if (sine(t) < kLeastSine) bad.push_back(t);
    }
    return true;
  }

 private:
  double sine(Index t) const {
    const auto& [a, b, c] = surface_.corners(t);
    return std::min({corner_sine(points_[a], points_[b], points_[c]), corner_sine(points_[b], points_[c], points_[a]),
                     corner_sine(points_[c], points_[a], points_[b])});
  }

  double sine_around(Index corner) const {
    double least = std::numeric_limits<double>::infinity();
    surface_.for_fan(corner, kNone, [&](Index around) { least = std::min(least, sine(around / 3)); });
    return least;
  }

  /// Compass search; steps are shares of the longest side around.
  void raise(Index corner) {
    Vec2& p = points_[surface_.corners(corner / 3)[corner % 3]];
    double longest = 0;
    surface_.for_fan(corner, kNone, [&](Index around) {
      for (Index v : surface_.corners(around / 3)) longest = std::max(longest, (points_[v] - p).norm());
    });
    double best = sine_around(corner);
    constexpr double kLargest = 0.25, kSmallest = 1e-4;
    constexpr int kDirections = 8, kMostSteps = 40;
    double step = kLargest;
    for (int k = 0; k < kMostSteps && step > kSmallest; ++k) {
      const Vec2 from = p;
      Vec2 to = from;
      for (int turn = 0; turn < kDirections; ++turn) {
        p = from + rotated(Vec2(step * longest, 0), 2 * std::numbers::pi * turn / kDirections);
        const double here = sine_around(corner);
        if (here > best) best = here, to = p;
      }
      p = to;
      if (to == from) step /= 2;
    }
  }

  const space::Background& surface_;
  std::vector<Vec2>& points_;
};

}  // namespace

bool turn_back(const space::Background& surface, std::vector<Vec2>& points) { return Turning(surface, points).run(); }

}  // namespace qmorph::chart
