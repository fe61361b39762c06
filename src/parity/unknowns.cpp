// SPDX-License-Identifier: GPL-2.0-or-later
#include "parity/unknowns.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace qmorph::parity {

double harm(const CurveWish& curve, int segments) {
  // An edge of a size or less, halved, makes quads that are twice as long as wide all along what is beside it.
  constexpr double kHalved = 4;
  constexpr double kShortestWish = 0.5;
  const double wish = std::max(curve.wish, kShortestWish), off = std::log(segments / wish);
  return curve.weight * wish * off * off + (curve.segments == 1 && segments > 1 ? kHalved : 0);
}

Unknowns::Unknowns(const std::vector<CurveWish>& curves, const std::vector<std::vector<Index>>& sets)
    : curves_(curves), of_curve_(curves.size(), kNone) {
  for (const std::vector<Index>& set : sets) {
    if (set.empty()) continue;
    Unknown unknown;
    unknown.curves = set;
    int sum = 0;
    for (Index c : set) {
      of_curve_[c] = Index(all_.size());
      unknown.least = std::max(unknown.least, curves[c].least);
      sum += curves[c].segments;
    }
    const auto fixed = std::find_if(set.begin(), set.end(), [&](Index c) { return curves[c].fixed; });
    unknown.fixed = fixed != set.end();
    unknown.segments = unknown.fixed ? curves[*fixed].segments : int(std::lround(double(sum) / double(set.size())));
    if (!unknown.fixed) unknown.segments = std::max(unknown.segments, unknown.least);
    all_.push_back(std::move(unknown));
  }
}

double Unknowns::cost(const Unknown& unknown, int segments) const {
  double sum = 0;
  for (Index c : unknown.curves) sum += harm(curves_[c], segments);
  return sum;
}

double Unknowns::price(Index i, int by) const {
  return cost(all_[i], all_[i].segments + by) - cost(all_[i], all_[i].segments);
}

std::vector<Share> shares_of(const Band& band, const Unknowns& unknowns) {
  std::map<Index, int> counts;
  for (Index c : band.one) ++counts[unknowns.of_curve(c)];
  for (Index c : band.other) --counts[unknowns.of_curve(c)];
  std::vector<Share> shares;
  for (const auto& [unknown, count] : counts)
    if (count != 0) shares.push_back({unknown, count});
  return shares;
}

int excess(const std::vector<Share>& band, const Unknowns& unknowns) {
  return std::accumulate(band.begin(), band.end(), 0, [&](int sum, const Share& share) {
    return sum + share.count * unknowns[share.unknown].segments;
  });
}

}  // namespace qmorph::parity
