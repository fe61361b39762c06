// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/lay_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bands/find_band.hpp"
#include "bands/plan_rows.hpp"

namespace qmorph::bands {
namespace {

std::vector<Vec2> points_of(const std::vector<Index>& nodes, const std::vector<Vec2>& points) {
  std::vector<Vec2> result;
  for (Index v : nodes) result.push_back(points[v]);
  return result;
}

int whole(double rows) { return std::clamp(int(std::lround(rows)), 1, kMostRows); }

/// Makes the quads of a plan.
class Layer {
 public:
  Layer(const Band& band, const RowPlan& plan, std::vector<Vec2> points) : band_(band), points_(std::move(points)) {
    for (const Step& step : plan.steps) {
      at_lower_ += step.kind == Step::row || !step.above;
      at_upper_ += step.kind == Step::row || step.above;
      last_ = step.kind == Step::row && &step == &plan.steps.back();
      if (&step == plan.steps.data()) begin(int(plan.first_rows));
      take(step);
    }
  }

  kernel::Mesh mesh() const { return {points_, faces_, {}}; }

 private:
  void begin(int rows) {
    if (!band_.is_ring) {
      rung_ = band_.start;
      return;
    }
    rung_ = between(band_.lower[0], band_.upper[0], rows);
    first_ = rung_;
  }

  Index node(const Vec2& p) {
    points_.push_back(p);
    return Index(points_.size() - 1);
  }

  /// A rung with new nodes inside.
  std::vector<Index> between(Index lower, Index upper, int rows) {
    std::vector<Index> rung{lower};
    const Vec2 from = points_[lower], way = points_[upper] - from;
    for (int s = 1; s < rows; ++s) rung.push_back(node(from + double(s) / rows * way));
    rung.push_back(upper);
    return rung;
  }

  void quad(Index a, Index b, Index c, Index d, bool above) {
    above ? faces_.push_back({a, b, c, d}) : faces_.push_back({d, c, b, a});
  }

  void take(const Step& step) {
    if (step.kind == Step::row) {
      const int rows = int(rung_.size()) - 1;
      std::vector<Index> next = !last_          ? between(band_.lower[at_lower_], band_.upper[at_upper_], rows)
                                : band_.is_ring ? first_
                                                : band_.end;
      for (int s = 0; s < rows; ++s) quad(rung_[s], next[s], next[s + 1], rung_[s + 1], true);
      rung_ = std::move(next);
      return;
    }
    if (!step.above) std::reverse(rung_.begin(), rung_.end());
    step.kind == Step::wedge ? wedge(step.above) : change(step);
    if (!step.above) std::reverse(rung_.begin(), rung_.end());
  }

  /// A triangle at the end of the rung.
  void wedge(bool above) {
    const Index old = rung_.back(), next = above ? band_.upper[at_upper_] : band_.lower[at_lower_];
    const Index tip = rung_[rung_.size() - 2];
    faces_.push_back({tip, above ? next : old, above ? old : next, kNone});
    rung_.back() = next;
  }

  /// The rung stays up to `level`, and is new from there to the next node of the far side.
  void change(const Step& step) {
    const std::size_t level = step.level, rows = rung_.size() - 1;
    const bool more = step.kind == Step::more;
    const Index far = step.above ? band_.upper[at_upper_] : band_.lower[at_lower_];
    const std::size_t count = more ? rows - level + 1 : rows - level - 1;  // rows of the new part
    const Vec2 from = points_[rung_[level]], way = points_[far] - from;
    std::vector<Index> part{rung_[level]};
    for (std::size_t s = 1; s < count; ++s) part.push_back(node(from + double(s) / double(count) * way));
    part.push_back(far);
    const std::vector<Index> old(rung_.begin() + std::ptrdiff_t(level), rung_.end());
    const std::vector<Index>&longer = more ? part : old, &shorter = more ? old : part;
    for (std::size_t s = 0; s + 1 < shorter.size(); ++s) {
      const std::array<Index, 4> q{shorter[s], longer[s + 1], longer[s + 2], shorter[s + 1]};
      more ? quad(q[0], q[1], q[2], q[3], step.above) : quad(q[3], q[2], q[1], q[0], step.above);
    }
    rung_.resize(level);
    rung_.insert(rung_.end(), part.begin(), part.end());
  }

  const Band& band_;
  std::vector<Vec2> points_;
  std::vector<std::array<Index, 4>> faces_;
  std::vector<Index> rung_, first_;
  std::size_t at_lower_ = 0, at_upper_ = 0;
  bool last_ = false;
};

Rails rails_of(const Band& band, const Facing& facing, const std::vector<Vec2>& points) {
  Rails rails{points_of(band.lower, points), points_of(band.upper, points), facing.node, facing.rows};
  rails.first_rows = band.is_ring ? whole(rails.rows.front()) : int(band.start.size()) - 1;
  rails.last_rows = band.is_ring ? rails.first_rows : int(band.end.size()) - 1;
  return rails;
}

/// Turns the upper side of a ring to where the lower one begins.
RowPlan plan_band(Band& band, const std::vector<Vec2>& points, const RowCosts& costs, double largest_gap) {
  const auto facing = find_facing(band, points, largest_gap);
  return facing ? plan_rows(rails_of(band, *facing, points), costs) : RowPlan{};
}

/// A ring is opened where rungs stand straight, midway between two changes of the plan before.
void open_better(Band& band, const RowPlan& plan) {
  std::size_t i = 0, since = 0, longest = 0, best = 0;
  for (const Step& step : plan.steps) {
    since = step.kind == Step::row ? since + 1 : 0;
    i += step.kind == Step::row || !step.above;
    if (since > longest) longest = since, best = i - since / 2;
  }
  band.lower.pop_back();
  std::rotate(band.lower.begin(), band.lower.begin() + std::ptrdiff_t(best % band.lower.size()), band.lower.end());
  band.lower.push_back(band.lower.front());
}

}  // namespace

std::optional<kernel::Mesh> lay_rows(const Band& band, const std::vector<Vec2>& points, const RowCosts& costs,
                                     double largest_gap) {
  Band best = band;
  RowPlan plan = plan_band(best, points, costs, largest_gap);
  if (plan.steps.empty()) return {};
  constexpr int kOpenings = 2;
  for (int opening = 0; band.is_ring && opening < kOpenings; ++opening) {
    Band other = best;
    open_better(other, plan);
    RowPlan better = plan_band(other, points, costs, largest_gap);
    if (better.steps.empty() || better.cost >= plan.cost) break;
    plan = std::move(better), best = std::move(other);
  }
  kernel::Mesh mesh = Layer(best, plan, points).mesh();
  constexpr std::size_t kWorkPerEdge = 40;
  mesh.add_work(kWorkPerEdge * band.lower.size());
  return mesh;
}

}  // namespace qmorph::bands
