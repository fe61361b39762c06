// SPDX-License-Identifier: GPL-2.0-or-later
#include "parity/shared_by_many.hpp"

#include <algorithm>
#include <map>

#include "parity/row.hpp"
#include "parity/sets.hpp"

namespace qmorph::parity {
namespace {

/// Regions that links of one and two regions join.
class Islands {
 public:
  Islands(std::size_t regions, const std::vector<PricedLink>& links) : sets_(regions), is_open_(regions, false) {
    for (const PricedLink& link : links)
      if (link.others.empty() && link.a != kOutside && link.b != kOutside) sets_.unite(link.a, link.b);
    for (const PricedLink& link : links) {
      if (!link.others.empty() || (link.a == kOutside) == (link.b == kOutside)) continue;
      is_open_[sets_.root(link.a == kOutside ? link.b : link.a)] = true;
    }
  }

  /// Islands without a way out of which an odd number of these regions is part.
  Row changed_by(const std::vector<Index>& regions) {
    std::vector<Index> roots;
    for (Index region : regions)
      if (const Index root = sets_.root(region); !is_open_[root]) roots.push_back(root);
    std::sort(roots.begin(), roots.end());
    Row odd;
    for (Index root : roots) odd.empty() || odd.back() != root ? odd.push_back(root) : odd.pop_back();
    return odd;
  }

 private:
  Sets sets_;
  std::vector<bool> is_open_;  ///< by root: a link leads to the outside
};

/// Islands that change together, and the links that do it.
struct Change {
  Row islands, links;
};

/// Changes of which each has a first island of its own, so that others are sums of them.
class Basis {
 public:
  /// Adds changes until their first island is that of none here; the change is what is left then.
  void reduce(Change& change) const {
    while (!change.islands.empty()) {
      const auto same = first_.find(change.islands.front());
      if (same == first_.end()) return;
      change = {symmetric_difference(change.islands, same->second.islands),
                symmetric_difference(change.links, same->second.links)};
    }
  }
  void add(Change change) {
    reduce(change);
    if (!change.islands.empty()) first_.emplace(change.islands.front(), std::move(change));
  }

 private:
  std::map<Index, Change> first_;
};

/// One link for each set of islands that a link changes, the cheapest one; cheap ones first.
std::vector<Change> changes_by_cost(Islands& islands, const std::vector<PricedLink>& links) {
  std::map<Row, Index> cheapest;
  for (Index i = 0; i < links.size(); ++i) {
    if (links[i].others.empty()) continue;
    const Row changed = islands.changed_by(regions_of(links[i]));
    if (changed.empty()) continue;
    const auto [at, is_new] = cheapest.try_emplace(changed, i);
    if (!is_new && links[i].cost < links[at->second].cost) at->second = i;
  }
  std::vector<Change> changes;
  for (const auto& [changed, link] : cheapest) changes.push_back({changed, {link}});
  std::stable_sort(changes.begin(), changes.end(), [&](const Change& a, const Change& b) {
    return links[a.links.front()].cost < links[b.links.front()].cost;
  });
  return changes;
}

}  // namespace

std::vector<Index> regions_of(const PricedLink& link) {
  std::vector<Index> regions = link.others;
  for (Index region : {link.a, link.b})
    if (region != kOutside) regions.push_back(region);
  return regions;
}

std::vector<Index> choose_shared_by_many(const std::vector<bool>& odd, const std::vector<PricedLink>& links) {
  if (std::all_of(links.begin(), links.end(), [](const PricedLink& link) { return link.others.empty(); })) return {};
  Islands islands(odd.size(), links);
  std::vector<Index> odd_regions;
  for (Index r = 0; r < odd.size(); ++r)
    if (odd[r]) odd_regions.push_back(r);
  Change wanted{islands.changed_by(odd_regions), {}};
  if (wanted.islands.empty()) return {};
  Basis basis;
  for (Change& change : changes_by_cost(islands, links)) basis.add(std::move(change));
  while (!wanted.islands.empty()) {
    basis.reduce(wanted);
    if (!wanted.islands.empty()) wanted.islands.erase(wanted.islands.begin());  // this one stays odd
  }
  return wanted.links;
}

}  // namespace qmorph::parity
