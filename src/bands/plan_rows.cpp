// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/plan_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "bands/find_band.hpp"

namespace qmorph::bands {
namespace {

/// Of e times as many rows as are wanted, or as few, in quads of scaled Jacobian 0.
constexpr double kAspect = 0.05;
constexpr unsigned kKinds = Step::wedge + 1;
/// How many nodes a rung may lean, beyond the node that faces.
constexpr int kLag = 3, kWidth = 2 * kLag + 1;

/// How a rung was reached: by a row (or it is the first), by a change to fewer rows or a triangle, by one to more on
/// either side.
enum Mode : std::uint8_t { kRow, kFewer, kMore };
constexpr int kModes = kMore + 2 * kMostRows;
constexpr int more_mode(bool above, int level) { return kMore + 2 * level + above; }

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double badness(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double sine = smallest_corner_sine(a, b, c, d);
  constexpr double kInverted = 4;
  return sine > 0 ? 1 - sine : 1 - kInverted * sine;
}

/// The same of a triangle; none if it is equilateral.
double badness(const Vec2& a, const Vec2& b, const Vec2& c) {
  constexpr double kEquilateral = 3.4641016151377544;  // squared sides over twice the area
  const double doubled_area = cross(b - a, c - a);
  return 1 - kEquilateral * doubled_area / ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
}

class Planner {
 public:
  Planner(const Rails& rails, const RowCosts& costs)
      : rails_(rails),
        costs_(costs),
        b_(rails.lower),
        t_(rails.upper),
        is_odd_((b_.size() + t_.size() + std::size_t(rails.first_rows + rails.last_rows)) % 2 != 0),
        states_((is_odd_ ? 2 : 1) * kStatesBefore),
        came_(b_.size() * states_),
        now_(states_),
        ahead_(states_) {}

  RowPlan run() {
    std::fill(now_.begin(), now_.end(), kInfinite);
    const int start = -int(rails_.facing[0]);
    if (std::abs(start) > kLag) return {};
    now_[state(start + kLag, rails_.first_rows, kRow)] = 0;
    for (i_ = 0; i_ < b_.size(); ++i_) {
      std::fill(ahead_.begin(), ahead_.end(), kInfinite);
      for (int lag = -kLag; lag <= kLag; ++lag) {
        const int j = int(rails_.facing[i_]) + lag;
        if (j >= 0 && j < int(t_.size())) leave(Index(j));
      }
      if (i_ + 1 < b_.size()) std::swap(now_, ahead_);
    }
    return trace_back();
  }

 private:
  static constexpr std::size_t kStatesBefore = kWidth * kMostRows * kModes;
  /// Before the triangle of an odd band, and after it. An even band has the first ones only.
  static int state(int column, int rows, int mode, bool is_after = false) {
    return ((is_after * kWidth + column) * kMostRows + rows - 1) * kModes + mode;
  }
  /// The column of (i, j), or -1.
  int column(std::size_t i, std::size_t j) const {
    if (i >= b_.size() || j >= t_.size()) return -1;
    const int c = int(j) - int(rails_.facing[i]) + kLag;
    return c >= 0 && c < kWidth ? c : -1;
  }

  /// Half a row more than are wanted, and those at the ends of a strip.
  int most_rows(std::size_t i) const {
    constexpr double kSpare = 1.6;
    return std::clamp(int(rails_.rows[i] + kSpare), std::max({2, rails_.first_rows, rails_.last_rows}), kMostRows);
  }

  Vec2 on_rung(std::size_t i, std::size_t j, double share) const { return b_[i] + share * (t_[j] - b_[i]); }

  /// Between rungs (i, j) and (i + 1, j + 1).
  double cost_of_row(std::size_t j, int rows) const {
    double sum = 0;
    const std::size_t i = i_;
    for (int s = 0; s < rows; ++s) {
      const double low = double(s) / rows, high = double(s + 1) / rows;
      sum += badness(on_rung(i, j, low), on_rung(i + 1, j + 1, low), on_rung(i + 1, j + 1, high), on_rung(i, j, high));
    }
    constexpr double kFewest = 0.05;
    const double wanted = std::max(rails_.rows[i], kFewest), stretch = std::log(wanted / rows);
    return std::max(1.0, wanted) * (sum / rows + kAspect * stretch * stretch);
  }

  void reach(std::size_t i, std::size_t j, int rows, int mode, double cost, const Step& step, int from_mode) {
    const int c = column(i, j);
    if (c < 0 || rows > most_rows(i)) return;
    const int s = state(c, rows, mode, is_after_ || step.kind == Step::wedge);
    double& target = (i == i_ ? now_ : ahead_)[s];
    if (cost >= target) return;
    target = cost;
    came_[i * states_ + s] =
        std::uint16_t(1 + step.kind + kKinds * (step.above + 2 * (step.level + kMostRows * from_mode)));
  }

  void leave(Index j) {
    for (bool is_after : {false, true}) {
      if (is_after && !is_odd_) break;
      is_after_ = is_after;
      leave_for_all(j);
    }
  }

  void leave_for_all(Index j) {
    const int c = column(i_, j);
    for (int rows = 1; rows <= kMostRows; ++rows) {
      double row_cost = -1;
      for (int mode = 0; mode < kModes; ++mode) {
        const double cost = now_[state(c, rows, mode, is_after_)];
        if (cost == kInfinite) continue;
        if (i_ + 1 < b_.size() && j + 1 < t_.size()) {
          if (row_cost < 0) row_cost = cost_of_row(j, rows);
          reach(i_ + 1, j + 1, rows, kRow, cost + row_cost, {}, mode);
        }
        change(j, rows, mode, cost);
        if (is_odd_ && !is_after_ && mode == kRow) wedge(j, rows, cost);
      }
    }
  }

  void change(Index j, int rows, int mode, double cost) {
    for (bool above : {false, true}) {
      const std::size_t i2 = i_ + !above, j2 = j + above;
      if (column(i2, j2) < 0) continue;
      if (mode == kRow)
        for (int level = 0; level < rows; ++level)
          reach(i2, j2, rows + 1, more_mode(above, level), cost + cost_of_change(j, i2, j2, rows, true, above),
                {Step::more, above, (unsigned char)level}, mode);
      if (rows == 1 || mode == kFewer) continue;
      for (int level = 0; level < rows - 1; ++level) {
        const bool follows = mode >= kMore;
        // A row that has just turned must not turn back at once, but one beside it may.
        if (follows && mode != more_mode(above, level - 1) && mode != more_mode(above, level + 1)) continue;
        reach(i2, j2, rows - 1, kFewer,
              cost + (follows ? costs_.pair : cost_of_change(j, i2, j2, rows - 1, false, above)),
              {Step::fewer, above, (unsigned char)level}, mode);
      }
    }
  }

  /// A triangle of an edge of one side and the next node of the rung, which has five edges then if it is inside.
  void wedge(Index j, int rows, double cost) {
    const double share = 1.0 / rows, change = rows > 1 ? costs_.change : 0;
    if (column(i_ + 1, j) >= 0)
      reach(i_ + 1, j, rows, kFewer, cost + change + badness(b_[i_], b_[i_ + 1], on_rung(i_, j, share)),
            {Step::wedge, false, 0}, kRow);
    if (column(i_, j + 1) >= 0)
      reach(i_, j + 1, rows, kFewer, cost + change + badness(t_[j + 1], t_[j], on_rung(i_, j, 1 - share)),
            {Step::wedge, true, 0}, kRow);
  }

  /// Of a turn between rungs (i, j) and (i2, j2), one of which has `rows` rows and the other one more: the worst of the
  /// three quads there, wherever their common node may be put.
  double cost_of_change(std::size_t j, std::size_t i2, std::size_t j2, int rows, bool more, bool above) const {
    // As if the side with the edge were above, and there were more rows afterwards.
    const std::vector<Vec2>&side = above ? t_ : b_, &other = above ? b_ : t_;
    std::size_t near = above ? j : i_, far = above ? j2 : i2;
    const std::size_t stay = above ? i_ : j;
    if (!more) std::swap(near, far);
    const std::size_t ahead = more ? far + 1 : far - 1, beyond = more ? stay + 1 : stay - 1;  // may be SIZE_MAX
    if (ahead >= side.size() || beyond >= other.size()) return costs_.change + costs_.turn;
    const double share = double(rows - 1) / (rows + 1), turn = double(rows) / (rows + 1);
    const Vec2 a = other[stay] + share * (side[far] - other[stay]),
               b = other[beyond] + share * (side[ahead] - other[beyond]);
    const Vec2 m = other[stay] + turn * (side[far] - other[stay]),
               n = other[beyond] + turn * (side[ahead] - other[beyond]);
    const bool flipped = more != above;
    double least = 2;
    for (double step : {0.05, 0.15, 0.25}) {
      const Vec2 q = m + step * (n - m);
      const auto bad = [&](const Vec2& p, const Vec2& r, const Vec2& s, const Vec2& t) {
        return flipped ? badness(t, s, r, p) : badness(p, r, s, t);
      };
      least = std::min(
          least, std::max({bad(a, q, side[far], side[near]), bad(a, b, n, q), bad(q, n, side[ahead], side[far])}));
    }
    return costs_.change + costs_.turn * least;
  }

  RowPlan trace_back() const {
    RowPlan plan;
    const int last = column(b_.size() - 1, t_.size() - 1);
    if (last < 0) return plan;
    int rows = rails_.last_rows, mode = kRow;
    bool is_after = is_odd_;
    plan.cost = now_[state(last, rows, mode, is_after)];
    if (plan.cost == kInfinite) return plan;
    plan.first_rows = Index(rails_.first_rows);
    std::size_t i = b_.size() - 1, j = t_.size() - 1;
    while (i > 0 || j > 0) {
      unsigned code = came_[i * states_ + state(column(i, j), rows, mode, is_after)];
      if (code == 0) return {};
      --code;
      Step step;
      step.kind = Step::Kind(code % kKinds), code /= kKinds;
      step.above = code % 2, code /= 2;
      step.level = (unsigned char)(code % kMostRows), mode = int(code / kMostRows);
      plan.steps.push_back(step);
      if (step.kind == Step::row)
        --i, --j;
      else
        step.above ? --j : --i;
      if (step.kind == Step::more) --rows;
      if (step.kind == Step::fewer) ++rows;
      if (step.kind == Step::wedge) is_after = false;
    }
    std::reverse(plan.steps.begin(), plan.steps.end());
    return plan;
  }

  const Rails& rails_;
  const RowCosts& costs_;
  const std::vector<Vec2>&b_, &t_;
  bool is_odd_;
  std::size_t states_;     ///< of a rung
  bool is_after_ = false;  ///< the triangle
  std::size_t i_ = 0;
  std::vector<std::uint16_t> came_;
  std::vector<double> now_, ahead_;
};

}  // namespace

RowPlan plan_rows(const Rails& rails, const RowCosts& costs) { return Planner(rails, costs).run(); }

}  // namespace qmorph::bands
