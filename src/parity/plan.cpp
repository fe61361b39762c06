// SPDX-License-Identifier: GPL-2.0-or-later
#include "parity/plan.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>

#include "parity/matching.hpp"
#include "parity/shared_by_many.hpp"

namespace qmorph::parity {
namespace {

constexpr Cost kOneSplit = Cost{1} << 32;
/// The matching takes the cube of this, and more.
constexpr std::size_t kMostExact = 160;
constexpr Cost kFar = std::numeric_limits<Cost>::max();

struct Step {
  Index to, link;
  Cost cost;
};

/// The regions and, last, the outside, with the cheapest link of each pair. Links of more regions are left out.
class Graph {
 public:
  Graph(std::size_t regions, const std::vector<PricedLink>& links) : outside_(Index(regions)), steps_(regions + 1) {
    std::map<std::pair<Index, Index>, Index> best;
    for (Index i = 0; i < links.size(); ++i) {
      if (!links[i].others.empty()) continue;
      const Index a = node_of(links[i].a), b = node_of(links[i].b);
      if (a == b) continue;  // both sides are one region's: nothing changes
      const auto [at, is_new] = best.try_emplace(std::minmax(a, b), i);
      if (!is_new && links[i].cost < links[at->second].cost) at->second = i;
    }
    for (const auto& [pair, i] : best) {
      steps_[pair.first].push_back({pair.second, i, links[i].cost});
      steps_[pair.second].push_back({pair.first, i, links[i].cost});
    }
  }

  Index outside() const { return outside_; }
  std::size_t size() const { return steps_.size(); }
  const std::vector<Step>& steps(Index node) const { return steps_[node]; }

 private:
  Index node_of(Index region) const { return region == kOutside ? outside_ : region; }

  Index outside_;
  std::vector<std::vector<Step>> steps_;
};

/// The cheapest ways from one node to all others (Dijkstra).
struct Ways {
  Ways(const Graph& graph, Index from) : cost(graph.size(), kFar), last(graph.size()) {
    using Entry = std::pair<Cost, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    cost[from] = 0;
    queue.push({0, from});
    while (!queue.empty()) {
      const auto [passed, node] = queue.top();
      queue.pop();
      if (passed != cost[node]) continue;
      for (const Step& step : graph.steps(node)) {
        if (passed + step.cost >= cost[step.to]) continue;
        cost[step.to] = passed + step.cost;
        last[step.to] = {node, step.link, step.cost};
        queue.push({cost[step.to], step.to});
      }
    }
  }

  std::vector<Cost> cost;
  std::vector<Step> last;  ///< of the way to each node; `to` is where it comes from
};

/// Terminals that could do better with one another than each with the outside hang together; each such group can be
/// paired for itself, which keeps the matchings small.
std::vector<std::vector<Index>> groups_of(const std::vector<Index>& terminals, const std::vector<Ways>& ways,
                                          Index outside) {
  std::vector<Index> group(terminals.size(), kNone);
  std::vector<std::vector<Index>> groups;
  for (Index first = 0; first < terminals.size(); ++first) {
    if (group[first] != kNone) continue;
    std::vector<Index> members{first};
    group[first] = first;
    for (std::size_t k = 0; k < members.size(); ++k) {  // grows
      const Ways& here = ways[members[k]];
      for (Index other = 0; other < terminals.size(); ++other) {
        if (group[other] != kNone) continue;
        const Cost alone_here = here.cost[outside], alone_there = ways[other].cost[outside];
        const Cost together = here.cost[terminals[other]];
        if (together == kFar) continue;
        if (alone_here != kFar && alone_there != kFar && together >= alone_here + alone_there) continue;
        group[other] = first;
        members.push_back(other);
      }
    }
    groups.push_back(std::move(members));
  }
  return groups;
}

/// Fewest splits first, then the longest edges.
std::vector<PricedLink> price(std::size_t regions, const std::vector<Link>& links) {
  double most = 0;
  for (const Link& link : links) most = std::max(most, link.length);
  // However many short edges a plan has, they never weigh as much as one split more.
  const Cost most_extra = kOneSplit / Cost(regions + 2);
  std::vector<PricedLink> priced;
  for (const Link& link : links) {
    const double shortness = most > 0 ? 1 - link.length / most : 0;
    priced.push_back({link.a, link.b, link.splits * kOneSplit + Cost(shortness * double(most_extra)), link.others});
  }
  return priced;
}

/// Pairs of terminals that are near each other, taken out as long as there are more than `most`: each terminal in turn
/// with the nearest one left.
std::vector<std::pair<Index, Index>> take_near_pairs(std::vector<Index>& members, std::size_t most,
                                                     const std::vector<Index>& terminals,
                                                     const std::vector<Ways>& ways) {
  std::vector<std::pair<Index, Index>> pairs;
  while (members.size() > most) {
    const Index first = members.back();
    members.pop_back();
    const auto cost_to = [&](Index other) { return ways[first].cost[terminals[other]]; };
    const auto nearest =
        std::min_element(members.begin(), members.end(), [&](Index i, Index j) { return cost_to(i) < cost_to(j); });
    pairs.emplace_back(first, *nearest);
    members.erase(nearest);
  }
  return pairs;
}

/// Of links that change two regions at most.
Plan join_in_pairs(const std::vector<bool>& odd, const std::vector<PricedLink>& links) {
  const Graph graph(odd.size(), links);
  std::vector<Index> terminals;
  std::vector<Ways> ways;
  for (Index r = 0; r < odd.size(); ++r)
    if (odd[r]) {
      terminals.push_back(r);
      ways.emplace_back(graph, r);
    }

  Plan plan;
  std::vector<bool> split(links.size(), false);
  // Two ways over one link: neither needs it.
  const auto walk = [&](const Ways& from, Index start, Index goal) {
    for (Index node = goal; node != start; node = from.last[node].to)
      split[from.last[node].link] = !split[from.last[node].link];
  };
  for (std::vector<Index>& members : groups_of(terminals, ways, graph.outside())) {
    for (const auto& [i, j] : take_near_pairs(members, kMostExact, terminals, ways))
      walk(ways[i], terminals[i], terminals[j]);
    // One that is over goes to the outside; where no link leads there, it is any one that stays odd.
    const std::size_t size = members.size() + members.size() % 2;
    const auto cost_of = [&](std::size_t i, std::size_t j) {
      const Ways& from = ways[members[i]];
      if (j < members.size()) return from.cost[terminals[members[j]]];
      return from.cost[graph.outside()] == kFar ? 0 : from.cost[graph.outside()];
    };
    CostTable costs(size);
    for (std::size_t i = 0; i < members.size(); ++i)
      for (std::size_t j = i + 1; j < size; ++j) costs.set(i, j, cost_of(i, j));
    const std::vector<Index> mate = cheapest_matching(costs);
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (mate[i] < i) continue;
      const Ways& from = ways[members[i]];
      const bool alone = mate[i] == members.size();
      const Index goal = alone ? graph.outside() : terminals[members[mate[i]]];
      if (from.cost[goal] == kFar) {
        plan.odd_left.push_back(terminals[members[i]]);
        continue;
      }
      walk(from, terminals[members[i]], goal);
    }
  }
  for (Index i = 0; i < links.size(); ++i)
    if (split[i]) plan.splits.push_back(i);
  std::sort(plan.odd_left.begin(), plan.odd_left.end());
  return plan;
}

}  // namespace

Plan plan_splits(const std::vector<bool>& odd, const std::vector<Link>& links) {
  return plan_cheapest(odd, price(odd.size(), links));
}

Plan plan_cheapest(std::vector<bool> odd, const std::vector<PricedLink>& links) {
  const std::vector<Index> shared = choose_shared_by_many(odd, links);
  for (Index link : shared)
    for (Index region : regions_of(links[link])) odd[region] = !odd[region];
  Plan plan = join_in_pairs(odd, links);
  plan.splits.insert(plan.splits.end(), shared.begin(), shared.end());
  std::sort(plan.splits.begin(), plan.splits.end());
  return plan;
}

}  // namespace qmorph::parity
