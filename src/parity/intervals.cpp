// SPDX-License-Identifier: GPL-2.0-or-later
#include "parity/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "parity/balance.hpp"
#include "parity/plan.hpp"
#include "parity/row.hpp"
#include "parity/unknowns.hpp"

namespace qmorph::parity {
namespace {

using Shares = std::vector<Share>;

/// Sides whose numbers are farther apart than this need rows that end between them.
bool is_near(double a, double b) {
  constexpr double kMostRatio = 1.4;
  return std::max(a, b) <= kMostRatio * std::max(1.0, std::min(a, b));
}

/// Members of a band that are to change: one of each side as long as there are, which may both go up.
std::vector<Shares> in_pairs(const Shares& band, const std::vector<int>& sign) {
  Shares one, other;
  for (const Share& share : band)
    if (sign[share.unknown] != 0) (share.count > 0 ? one : other).push_back(share);
  if (one.size() < other.size()) std::swap(one, other);
  std::vector<Shares> pairs;
  for (std::size_t k = 0; k < other.size(); ++k) pairs.push_back({one[k], other[k]});
  for (std::size_t k = other.size(); k + 1 < one.size(); k += 2) pairs.push_back({one[k], one[k + 1]});
  return pairs;
}

class Planner {
 public:
  explicit Planner(const IntervalProblem& problem)
      : problem_(problem), unknowns_(problem.curves, alike(problem)), toll_(problem.curves.size(), 0) {
    for (const Band& band : problem.bands) shares_.push_back(shares_of(band, unknowns_));
    is_band_.assign(shares_.size(), false);
  }

  IntervalPlan run() {
    for (Index u = 0; u < unknowns_.size(); ++u) settle(u);
    for (Index b = 0; b < shares_.size(); ++b) is_band_[b] = may_fit(problem_.bands[b]);
    std::vector<Shares> bands;
    for (Index b = 0; b < shares_.size(); ++b)
      if (is_band_[b]) bands.push_back(shares_[b]);
    balance(unknowns_, bands, 1);
    make_even();
    balance(unknowns_, bands, 2);
    return write();
  }

  /// From the problem's own numbers on: only what makes surfaces even.
  /// \param toll by curve: what another number costs besides
  IntervalPlan only_make_even(std::vector<double> toll) {
    toll_ = std::move(toll);
    make_even();
    return write();
  }

 private:
  IntervalPlan write() const {
    IntervalPlan plan;
    for (Index c = 0; c < problem_.curves.size(); ++c)
      plan.segments.push_back(unknowns_[unknowns_.of_curve(c)].segments);
    for (Index s = 0; s < problem_.surfaces.size(); ++s)
      if (sum(problem_.surfaces[s]) % 2 != 0) plan.odd.push_back(s);
    for (const Shares& band : shares_) plan.fitting += excess(band, unknowns_) == 0;
    return plan;
  }

  static std::vector<Row> alike(const IntervalProblem& problem);

  /// To the number that costs least.
  void settle(Index u) {
    for (int by : {1, -1})
      while (unknowns_.may_change(u, by) && unknowns_.price(u, by) < 0) unknowns_.change(u, by);
  }

  int sum(const std::vector<Index>& curves) const {
    return std::accumulate(curves.begin(), curves.end(), 0,
                           [&](int s, Index c) { return s + unknowns_[unknowns_.of_curve(c)].segments; });
  }
  bool may_fit(const Band& band) const { return is_near(sum(band.one), sum(band.other)); }

  Row row_of(const std::vector<Index>& curves) const {
    Row row;
    for (Index c : curves) row = symmetric_difference(row, {unknowns_.of_curve(c)});
    return row;
  }
  std::vector<Row> rows() const;  ///< unknowns whose sum is to be even
  std::vector<Row> links_of(const std::vector<Row>& rows) const;
  std::int64_t price(Index u) const;
  void make_even();
  void apply(const std::vector<Index>& changed);

  const IntervalProblem& problem_;
  Unknowns unknowns_;
  std::vector<Shares> shares_;  ///< of the bands
  std::vector<char> is_band_;
  std::vector<double> toll_;  ///< of the problem's curves
};

/// Images, and curves alone on both sides of a band whose wishes are near.
std::vector<Row> Planner::alike(const IntervalProblem& problem) {
  const std::size_t count = problem.curves.size();
  Sets sets(count);
  for (const auto& [a, b] : problem.images) sets.unite(a, b);
  struct Extent {
    int fewest, most;  ///< segments that are wished
    int least;         ///< and allowed
    int fixed;         ///< number, or 0
  };
  std::vector<Extent> extents(count);
  for (Index c = 0; c < count; ++c) {
    const CurveWish& curve = problem.curves[c];
    extents[c] = {curve.segments, curve.segments, curve.least, curve.fixed ? curve.segments : 0};
  }
  const auto join = [](const Extent& a, const Extent& b) {
    return Extent{std::min(a.fewest, b.fewest), std::max(a.most, b.most), std::max(a.least, b.least),
                  std::max(a.fixed, b.fixed)};
  };
  for (Index c = 0; c < count; ++c) extents[sets.root(c)] = join(extents[sets.root(c)], extents[c]);
  for (const Band& band : problem.bands) {
    if (band.one.size() != 1 || band.other.size() != 1) continue;
    const Index a = sets.root(band.one[0]), b = sets.root(band.other[0]);
    const Extent both = join(extents[a], extents[b]);
    if (a == b || !is_near(both.fewest, both.most)) continue;
    if (extents[a].fixed && extents[b].fixed && extents[a].fixed != extents[b].fixed) continue;
    if (both.fixed && both.fixed < both.least) continue;
    sets.unite(a, b);
    extents[sets.root(a)] = both;
  }
  return sets.members();
}

/// A balanced band is even by itself, and so is then what its surface has besides. A change that goes through the
/// surface takes two curves of the band or two of the rest, and never one of each.
std::vector<Row> Planner::rows() const {
  std::vector<Row> rows;
  for (const std::vector<Index>& surface : problem_.surfaces) rows.push_back(row_of(surface));
  for (Index b = 0; b < shares_.size(); ++b) {
    if (!is_band_[b] || excess(shares_[b], unknowns_) != 0) continue;
    const Band& band = problem_.bands[b];
    std::vector<Index> curves = band.one;
    curves.insert(curves.end(), band.other.begin(), band.other.end());
    const Row row = row_of(curves);
    if (row.empty()) continue;
    rows.push_back(row);
    if (band.surface != kNone) rows[band.surface] = symmetric_difference(rows[band.surface], row);
  }
  // Surfaces that are images of one another ask for the same.
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

/// Of each unknown: the rows that it is in.
std::vector<Row> Planner::links_of(const std::vector<Row>& rows) const {
  std::vector<Row> links(unknowns_.size());
  for (Index r = 0; r < rows.size(); ++r)
    for (Index u : rows[r]) links[u].push_back(r);
  return links;
}

std::int64_t Planner::price(Index u) const {
  constexpr double kScale = 1e6;
  double least = unknowns_.price(u, 1);
  if (unknowns_.may_change(u, -1)) least = std::min(least, unknowns_.price(u, -1));
  for (Index c : unknowns_[u].curves) least += toll_[c];
  return std::max(std::int64_t{1}, std::int64_t(kScale * least));
}

void Planner::make_even() {
  const std::vector<Row> rows = this->rows(), links = links_of(rows);
  std::vector<bool> odd;
  for (const Row& row : rows)
    odd.push_back(
        std::accumulate(row.begin(), row.end(), 0, [&](int s, Index u) { return s + unknowns_[u].segments; }) % 2 != 0);
  std::vector<PricedLink> priced;
  std::vector<Index> of_link;
  for (Index u = 0; u < unknowns_.size(); ++u) {
    const Row& rows_of_u = links[u];
    if (!unknowns_.may_change(u, 1) || rows_of_u.empty()) continue;
    PricedLink link{rows_of_u[0], kOutside, price(u)};
    if (rows_of_u.size() > 1) link.b = rows_of_u[1];
    if (rows_of_u.size() > 2) link.others.assign(rows_of_u.begin() + 2, rows_of_u.end());
    priced.push_back(std::move(link));
    of_link.push_back(u);
  }
  std::vector<Index> changed;
  for (Index link : plan_cheapest(odd, priced).splits) changed.push_back(of_link[link]);
  apply(changed);
}

/// One more or one less for each, so that balanced bands stay so: those that share a band take their signs from one
/// another, and the first of them the one that is better for all.
void Planner::apply(const std::vector<Index>& changed) {
  std::vector<int> sign(unknowns_.size(), 0);
  std::vector<std::vector<Shares>> bands_of(unknowns_.size());
  for (Index u : changed) sign[u] = 2;  // to be decided
  for (Index b = 0; b < shares_.size(); ++b) {
    if (!is_band_[b] || excess(shares_[b], unknowns_) != 0) continue;
    for (const Shares& pair : in_pairs(shares_[b], sign))
      for (const Share& share : pair) bands_of[share.unknown].push_back(pair);
  }
  for (Index first : changed) {
    if (sign[first] != 2) continue;
    std::vector<Index> group{first};
    sign[first] = 1;
    for (std::size_t k = 0; k < group.size(); ++k)  // grows
      for (const Shares& pair : bands_of[group[k]]) {
        const bool is_first = pair[0].unknown == group[k];
        const Index other = pair[is_first ? 1 : 0].unknown;
        if (sign[other] != 2) continue;
        sign[other] = pair[0].count * pair[1].count > 0 ? -sign[group[k]] : sign[group[k]];
        group.push_back(other);
      }
    double gain = 0;
    bool up = true, down = true;
    for (Index u : group) {
      up = up && unknowns_.may_change(u, sign[u]);
      down = down && unknowns_.may_change(u, -sign[u]);
      gain += unknowns_.price(u, sign[u]) - unknowns_.price(u, -sign[u]);
    }
    const int turn = (gain > 0 && down) || !up ? -1 : 1;
    for (Index u : group) unknowns_.change(u, unknowns_.may_change(u, turn * sign[u]) ? turn * sign[u] : 1);
  }
}

/// Where bands leave surfaces odd, as few of them as possible are given up.
IntervalPlan give_up_bands(const IntervalProblem& problem, const IntervalPlan& plan) {
  constexpr double kBroken = 1;  // what a curve of a band costs that gets another number than what is across
  IntervalProblem rest = problem;
  rest.bands.clear();
  std::vector<double> toll(problem.curves.size(), 0);
  for (const Band& band : problem.bands)
    for (const std::vector<Index>* side : {&band.one, &band.other})
      for (Index c : *side) toll[c] += kBroken;
  for (Index c = 0; c < rest.curves.size(); ++c) {
    CurveWish& curve = rest.curves[c];
    curve.segments = plan.segments[c];
    curve.least = std::min(curve.least, curve.segments);
  }
  IntervalPlan other = Planner(rest).only_make_even(std::move(toll));
  const auto sum = [&](const std::vector<Index>& curves) {
    return std::accumulate(curves.begin(), curves.end(), 0, [&](int s, Index c) { return s + other.segments[c]; });
  };
  other.fitting = std::size_t(std::count_if(problem.bands.begin(), problem.bands.end(),
                                            [&](const Band& band) { return sum(band.one) == sum(band.other); }));
  return other;
}

}  // namespace

IntervalPlan plan_intervals(const IntervalProblem& problem) {
  IntervalPlan plan = Planner(problem).run();
  if (plan.odd.empty()) return plan;
  IntervalPlan other = give_up_bands(problem, plan);
  return other.odd.size() < plan.odd.size() ? other : plan;
}

}  // namespace qmorph::parity
