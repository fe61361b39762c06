// SPDX-License-Identifier: GPL-2.0-or-later
#include "parity/matching.hpp"

#include <algorithm>
#include <limits>

namespace qmorph::parity {
namespace {

/// Nodes 0 .. n-1 are the graph's, those above are blossoms: odd cycles of nodes that act as one. Every node has a dual
/// value y, blossoms none below 0. An edge's slack is its cost less the duals of all nodes that it leaves; it never
/// falls below 0, and edges of the matching and of blossoms have none. When all nodes are matched, that proves that no
/// matching costs less.
class Matching {
 public:
  explicit Matching(const CostTable& costs) : n_(Index(costs.size())), costs_(costs) {
    nodes_.resize(n_);
    top_.resize(n_);
    mate_.assign(n_, kNone);
    sum_.resize(n_);
    for (Index v = 0; v < n_; ++v) {
      nodes_[v].base = top_[v] = v;
      sum_[v] = first_dual(v);
    }
  }

  std::vector<Index> run() {
    match_tight_pairs();
    while (std::count(mate_.begin(), mate_.end(), kNone)) {
      expand_empty_blossoms();
      while (!grow_trees()) {
      }
    }
    return mate_;
  }

 private:
  enum class Label { none, even, odd };
  struct Joint {
    Index from, to;  ///< vertices of the graph
  };
  struct Node {
    bool live = true;
    Cost dual = 0;              ///< of a blossom; that of a vertex is part of `sum_`
    Index base = kNone;         ///< the vertex inside that is matched to the outside, or not at all
    std::vector<Index> ring;    ///< of a blossom: its nodes, an odd number, the one with the base first
    std::vector<Joint> joints;  ///< joints[k] joins ring[k] to the next one
    Label label = Label::none;
    Joint entry{kNone, kNone};  ///< of an odd node: the edge by which its tree came
  };

  /// Costs are doubled, so that half a slack is a whole number: all vertices of the trees have sums of one parity.
  Cost cost(Index u, Index v) const { return 2 * costs_(u, v); }
  Cost slack(Index u, Index v) const { return cost(u, v) - sum_[u] - sum_[v]; }
  Node& top(Index v) { return nodes_[top_[v]]; }

  Cost first_dual(Index v) const {
    Cost least = std::numeric_limits<Cost>::max();
    for (Index u = 0; u < n_; ++u)
      if (u != v) least = std::min(least, cost(u, v));
    return least / 2 / 2 * 2;
  }

  void match_tight_pairs() {
    for (Index u = 0; u < n_; ++u)
      for (Index v = u + 1; v < n_ && mate_[u] == kNone; ++v)
        if (mate_[v] == kNone && slack(u, v) == 0) mate_[u] = v, mate_[v] = u;
  }

  template <class Visit>
  void for_each_vertex(Index node, const Visit& visit) const {
    if (node < n_) return visit(node);
    for (Index part : nodes_[node].ring) for_each_vertex(part, visit);
  }

  void expand(Index blossom) {
    for (Index part : nodes_[blossom].ring) for_each_vertex(part, [&](Index v) { top_[v] = part; });
    nodes_[blossom] = Node{};
    nodes_[blossom].live = false;
  }

  void expand_empty_blossoms() {
    for (bool again = true; again;) {
      again = false;
      for (Index v = 0; v < n_; ++v)
        if (top_[v] >= n_ && top(v).dual == 0) expand(top_[v]), again = true;
    }
  }

  /// Matches the inside of a node anew, so that `v` is the one that is left for the outside.
  void rebase(Index node, Index v) {
    Node& blossom = nodes_[node];
    blossom.base = v;
    if (node < n_) return;
    std::size_t first = 0;
    const auto holds = [&](Index part) {
      bool found = false;
      for_each_vertex(part, [&](Index u) { found = found || u == v; });
      return found;
    };
    while (!holds(blossom.ring[first])) ++first;
    std::rotate(blossom.ring.begin(), blossom.ring.begin() + std::ptrdiff_t(first), blossom.ring.end());
    std::rotate(blossom.joints.begin(), blossom.joints.begin() + std::ptrdiff_t(first), blossom.joints.end());
    rebase(blossom.ring[0], v);
    for (std::size_t k = 1; k < blossom.ring.size(); k += 2) {
      const auto [a, b] = blossom.joints[k];
      mate_[a] = b, mate_[b] = a;
      rebase(blossom.ring[k], a);
      rebase(blossom.ring[k + 1], b);
    }
  }

  /// Even nodes are those that an alternating path from an unmatched one reaches with a matched edge last.
  void plant() {
    for (Index v = 0; v < n_; ++v) top(v).label = Label::none;
    for (Index v = 0; v < n_; ++v)
      if (mate_[v] == kNone) top(v).label = Label::even;
  }

  /// One search. True if the matching has grown; false if a blossom was in the way and has been expanded.
  bool grow_trees() {
    plant();
    while (true) {
      const auto [edge, step] = next_tight_edge();
      const Index blocking = next_empty_blossom();
      if (blocking != kNone && nodes_[blocking].dual < step) {
        change_duals(nodes_[blocking].dual);
        expand(blocking);
        return false;
      }
      change_duals(step);
      const auto [u, v] = edge;
      if (top(v).label == Label::none) {
        top(v).label = Label::odd;
        top(v).entry = {u, v};
        top(mate_[top(v).base]).label = Label::even;
      } else if (root_of(u) == root_of(v)) {
        shrink(u, v);
      } else {
        flip_path(u, v);
        flip_path(v, u);
        return true;
      }
    }
  }

  /// The edge from an even node to an unlabelled or to another even one that gets tight first, and by how much the
  /// duals change until then.
  std::pair<Joint, Cost> next_tight_edge() {
    Joint best{kNone, kNone};
    Cost least = std::numeric_limits<Cost>::max();
    for (Index u = 0; u < n_; ++u) {
      if (top(u).label != Label::even) continue;
      for (Index v = 0; v < n_; ++v) {
        if (top_[u] == top_[v] || top(v).label == Label::odd) continue;
        const Cost step = top(v).label == Label::even ? slack(u, v) / 2 : slack(u, v);
        if (step < least) least = step, best = {u, v};
      }
    }
    return {best, least};
  }

  Index next_empty_blossom() {
    Index best = kNone;
    for (Index v = 0; v < n_; ++v)
      if (top_[v] >= n_ && top(v).label == Label::odd && (best == kNone || top(v).dual < nodes_[best].dual))
        best = top_[v];
    return best;
  }

  void change_duals(Cost step) {
    for (Index v = 0; v < n_; ++v) {
      if (top(v).label == Label::even) sum_[v] += step;
      if (top(v).label == Label::odd) sum_[v] -= step;
    }
    for (Index b = n_; b < nodes_.size(); ++b) {
      if (!nodes_[b].live || top_[nodes_[b].base] != b) continue;
      if (nodes_[b].label == Label::even) nodes_[b].dual += step;
      if (nodes_[b].label == Label::odd) nodes_[b].dual -= step;
    }
  }

  /// From an even node to the next even one towards its root; kNone from the root.
  Index parent(Index even) {
    const Index mate = mate_[nodes_[even].base];
    return mate == kNone ? kNone : top_[top(mate).entry.from];
  }

  Index root_of(Index v) {
    Index node = top_[v];
    for (Index up = parent(node); up != kNone; up = parent(node)) node = up;
    return node;
  }

  /// The edge u-v closes an odd cycle in a tree: it becomes a blossom.
  void shrink(Index u, Index v) {
    std::vector<Index> from_u{top_[u]}, from_v{top_[v]};
    while (parent(from_u.back()) != kNone) from_u.push_back(parent(from_u.back()));
    while (parent(from_v.back()) != kNone) from_v.push_back(parent(from_v.back()));
    while (from_u.size() > 1 && from_v.size() > 1 && from_u[from_u.size() - 2] == from_v[from_v.size() - 2])
      from_u.pop_back(), from_v.pop_back();

    Node blossom;
    blossom.label = Label::even;
    blossom.base = nodes_[from_u.back()].base;
    // Down to u, across, and up from v.
    for (std::size_t k = from_u.size(); k-- > 1;) {
      const Index base = nodes_[from_u[k - 1]].base, odd = top_[mate_[base]];
      blossom.ring.insert(blossom.ring.end(), {from_u[k], odd});
      blossom.joints.push_back(nodes_[odd].entry);
      blossom.joints.push_back({mate_[base], base});
    }
    blossom.ring.push_back(from_u[0]);
    blossom.joints.push_back({u, v});
    for (std::size_t k = 1; k < from_v.size(); ++k) {
      const Index base = nodes_[from_v[k - 1]].base, odd = top_[mate_[base]];
      blossom.ring.insert(blossom.ring.end(), {from_v[k - 1], odd});
      blossom.joints.push_back({base, mate_[base]});
      blossom.joints.push_back({nodes_[odd].entry.to, nodes_[odd].entry.from});
    }
    const auto number = Index(nodes_.size());
    for (Index part : blossom.ring) for_each_vertex(part, [&](Index w) { top_[w] = number; });
    nodes_.push_back(std::move(blossom));
  }

  /// Turns the path from the root to u, whose new partner is v.
  void flip_path(Index u, Index v) {
    while (true) {
      const Index node = top_[u], mate = mate_[nodes_[node].base];
      rebase(node, u);
      mate_[u] = v;
      if (mate == kNone) return;
      const Index odd = top_[mate];
      const Joint entry = nodes_[odd].entry;
      rebase(odd, entry.to);
      mate_[entry.to] = entry.from;
      u = entry.from, v = entry.to;
    }
  }

  const Index n_;
  const CostTable& costs_;
  std::vector<Node> nodes_;
  std::vector<Index> top_;  ///< the outermost node of each vertex
  std::vector<Index> mate_;
  std::vector<Cost> sum_;  ///< of the duals of all nodes that hold a vertex, itself included
};

}  // namespace

std::vector<Index> cheapest_matching(const CostTable& costs) {
  if (costs.size() == 0) return {};
  return Matching(costs).run();
}

}  // namespace qmorph::parity
