// SPDX-License-Identifier: GPL-2.0-or-later
#include "parity/balance.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <queue>

namespace qmorph::parity {
namespace {

/// What two irregular nodes are worth: a band that lacks a segment has a pair of them.
constexpr double kFairPrice = 1.0;

/// A band whose first side is to get one more than it has, against the second, or one less.
using State = Index;  // 2 * band + (more ? 1 : 0)
State state(Index band, int wanted) { return 2 * band + (wanted > 0 ? 1 : 0); }
int wanted(State s) { return s % 2 ? 1 : -1; }

struct Step {
  State from = kNone;
  Index unknown = kNone;
  int by = 0;
};

class Balance {
 public:
  Balance(Unknowns& unknowns, const std::vector<std::vector<Share>>& bands, int step)
      : unknowns_(unknowns), bands_(bands), step_(step), bands_of_(unknowns.size()) {
    for (Index b = 0; b < bands.size(); ++b)
      for (const Share& share : bands[b]) bands_of_[share.unknown].push_back({b, share.count});
  }

  void run() {
    for (Index b = 0; b < bands_.size(); ++b)
      for (int over = excess(bands_[b], unknowns_); std::abs(over) >= step_; over = excess(bands_[b], unknowns_))
        if (!mend(b, over > 0 ? -1 : 1)) break;
  }

 private:
  struct Place {
    Index band;
    int count;
  };

  int total_excess() const {
    int sum = 0;
    for (const std::vector<Share>& band : bands_) sum += std::abs(excess(band, unknowns_));
    return sum;
  }

  /// The cheapest path of changes that brings a band nearer to its balance by a step (Dijkstra).
  bool mend(Index band, int change) {
    using Entry = std::pair<double, State>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::vector<double> cost(2 * bands_.size(), std::numeric_limits<double>::max());
    std::vector<Step> came(2 * bands_.size());
    const State start = state(band, change);
    cost[start] = 0;
    queue.push({0, start});
    double best = kFairPrice;
    Step last;
    while (!queue.empty()) {
      const auto [passed, here] = queue.top();
      queue.pop();
      if (passed >= best) break;
      if (passed != cost[here]) continue;
      for (const Share& share : bands_[here / 2]) {
        if (std::abs(share.count) != 1) continue;
        const int by = wanted(here) * share.count * step_;
        if (!unknowns_.may_change(share.unknown, by)) continue;
        const double price = passed + std::max(0.0, unknowns_.price(share.unknown, by));
        const State next = next_state(share.unknown, by, here / 2);
        if (next == kNowhere) continue;
        if (next == kEnd) {
          if (price < best) best = price, last = {here, share.unknown, by};
        } else if (price < cost[next]) {
          cost[next] = price;
          came[next] = {here, share.unknown, by};
          queue.push({price, next});
        }
      }
    }
    return last.unknown != kNone && walk(last, came);
  }

  static constexpr State kEnd = kNone, kNowhere = kNone - 1;

  /// Where a change goes on to from one of the bands of an unknown.
  State next_state(Index unknown, int by, Index band) const {
    State next = kEnd;
    for (const Place& place : bands_of_[unknown]) {
      if (place.band == band) continue;
      const int change = place.count * by;
      if (std::abs(change) != step_ || next != kEnd) return kNowhere;
      if (excess(bands_[place.band], unknowns_) * change < 0) continue;  // it is for the better there, too
      next = state(place.band, -change);
    }
    return next;
  }

  bool walk(const Step& last, const std::vector<Step>& came) {
    std::vector<Step> done;
    const int before = total_excess();
    for (Step step = last;; step = came[step.from]) {
      unknowns_.change(step.unknown, step.by);
      done.push_back(step);
      if (came[step.from].unknown == kNone) break;
    }
    const bool allowed =
        std::all_of(done.begin(), done.end(), [&](const Step& s) { return unknowns_.may_change(s.unknown, 0); });
    if (allowed && total_excess() < before) return true;
    for (const Step& step : done) unknowns_.change(step.unknown, -step.by);
    return false;
  }

  Unknowns& unknowns_;
  const std::vector<std::vector<Share>>& bands_;
  int step_;
  std::vector<std::vector<Place>> bands_of_;
};

}  // namespace

void balance(Unknowns& unknowns, const std::vector<std::vector<Share>>& bands, int step) {
  Balance(unknowns, bands, step).run();
}

}  // namespace qmorph::parity
