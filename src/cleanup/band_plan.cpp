// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/band_plan.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace qmorph::cleanup {
namespace {

/// How far into the two rows the node next to a single rung will move, in edges.
constexpr double kTransitionStep = 0.3;
/// Cost of an irregular node, in quads of scaled Jacobian 0.
constexpr double kIrregular = 0.25;

enum Mode { one_row, entering, two_rows };  // one step at least lies between entering two rows and leaving them

double badness(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double sine = smallest_corner_sine(a, b, c, d);
  constexpr double kInverted = 4;  // smoothing may mend it, or not
  return sine > 0 ? 1 - sine : 1 - kInverted * sine;
}

class Planner {
 public:
  Planner(const std::vector<Vec2>& lower, const std::vector<Vec2>& upper, int most_lag)
      : b_(lower),
        t_(upper),
        lag_(most_lag),
        width_(2 * most_lag + 1),
        states_(lower.size() * std::size_t(width_) * 3) {}

  BandPlan run() {
    at(0, 0, one_row) = {0, kNone};
    for (Index i = 0; i < b_.size(); ++i)
      for (int lag = -lag_; lag <= lag_; ++lag) {
        const int j = int(i) + lag;
        if (j >= 0 && j < int(t_.size())) leave(i, Index(j));
      }
    return trace_back();
  }

 private:
  struct State {
    double cost = std::numeric_limits<double>::infinity();
    Index from = kNone;
  };

  bool exists(Index i, Index j) const { return i < b_.size() && j < t_.size() && std::abs(int(j) - int(i)) <= lag_; }
  std::size_t row(Index i, Index j, Mode mode) const {
    return (std::size_t(i) * width_ + std::size_t(int(j) - int(i) + lag_)) * 3 + mode;
  }
  State& at(Index i, Index j, Mode mode) { return states_[row(i, j, mode)]; }

  Vec2 middle(Index i, Index j) const { return 0.5 * (b_[i] + t_[j]); }
  /// Half-way between the rungs' ends and `steps` edges along.
  Vec2 shifted(Index i, Index j, double steps) const {
    const Index i0 = i > 0 ? i - 1 : i, j0 = j > 0 ? j - 1 : j;
    const Vec2 edge = 0.5 * (b_[i0 + 1] - b_[i0] + t_[j0 + 1] - t_[j0]);
    return middle(i, j) + steps * edge;
  }

  void reach(Index i, Index j, Mode from, Index i2, Index j2, Mode to, double cost) {
    State& target = at(i2, j2, to);
    const double sum = at(i, j, from).cost + cost;
    if (sum < target.cost) target = {sum, Index(row(i, j, from))};
  }

  // The order matters: entering from (i, j) reaches (i, j + 1), which comes later for the same i.
  void leave(Index i, Index j) {
    const auto possible = [&](Mode mode) { return at(i, j, mode).cost < std::numeric_limits<double>::infinity(); };
    if (possible(one_row)) {
      if (exists(i + 1, j + 1))
        reach(i, j, one_row, i + 1, j + 1, one_row, badness(b_[i], b_[i + 1], t_[j + 1], t_[j]));
      if (exists(i + 1, j))
        reach(i, j, one_row, i + 1, j, entering,
              kIrregular + badness(b_[i], b_[i + 1], shifted(i + 1, j, kTransitionStep), t_[j]));
      if (exists(i, j + 1))
        reach(i, j, one_row, i, j + 1, entering,
              kIrregular + badness(b_[i], shifted(i, j + 1, kTransitionStep), t_[j + 1], t_[j]));
    }
    for (Mode mode : {entering, two_rows})
      if (possible(mode) && exists(i + 1, j + 1)) {
        const Vec2 m = middle(i, j), n = middle(i + 1, j + 1);
        reach(i, j, mode, i + 1, j + 1, two_rows,
              0.5 * (badness(b_[i], b_[i + 1], n, m) + badness(m, n, t_[j + 1], t_[j])));
      }
    if (possible(two_rows)) {
      const Vec2 m = shifted(i, j, -kTransitionStep);
      if (exists(i, j + 1)) reach(i, j, two_rows, i, j + 1, one_row, kIrregular + badness(m, b_[i], t_[j + 1], t_[j]));
      if (exists(i + 1, j)) reach(i, j, two_rows, i + 1, j, one_row, kIrregular + badness(b_[i], b_[i + 1], t_[j], m));
    }
  }

  BandPlan trace_back() {
    BandPlan plan;
    const Index n = Index(b_.size()) - 1, m = Index(t_.size()) - 1;
    if (!exists(n, m)) return plan;
    plan.cost = at(n, m, one_row).cost;
    if (!(plan.cost < std::numeric_limits<double>::infinity())) return plan;
    for (std::size_t s = row(n, m, one_row); s != kNone; s = states_[s].from) {
      const std::size_t place = s / 3, i = place / width_;
      const int lag = int(place % width_) - lag_;
      plan.places.push_back({Index(i), Index(int(i) + lag), s % 3 != one_row});
    }
    std::reverse(plan.places.begin(), plan.places.end());
    return plan;
  }

  const std::vector<Vec2>&b_, &t_;
  int lag_, width_;
  std::vector<State> states_;
};

}  // namespace

BandPlan plan_band(const std::vector<Vec2>& lower, const std::vector<Vec2>& upper, int most_lag) {
  return Planner(lower, upper, most_lag).run();
}

}  // namespace qmorph::cleanup
