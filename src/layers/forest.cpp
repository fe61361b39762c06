// SPDX-License-Identifier: GPL-2.0-or-later
#include "layers/forest.hpp"

namespace qmorph::layers {

Forest::Forest(std::vector<bool> is_odd, const std::vector<Edge>& edges, const std::vector<Index>& roots)
    : is_odd_(std::move(is_odd)), root_(is_odd_.size(), kNone) {
  std::vector<std::vector<Index>> at(is_odd_.size());
  for (Index e = 0; e < edges.size(); ++e) at[edges[e].first].push_back(e), at[edges[e].second].push_back(e);
  std::vector<Index> order, parent(is_odd_.size(), kNone), via(is_odd_.size(), kNone);
  for (Index root : roots) {
    if (root_[root] != kNone) continue;
    root_[root] = root;
    order.push_back(root);
    for (std::size_t next = order.size() - 1; next < order.size(); ++next) {
      const Index node = order[next];
      for (Index e : at[node]) {
        const Index other = edges[e].first == node ? edges[e].second : edges[e].first;
        if (root_[other] != kNone) continue;
        root_[other] = root;
        parent[other] = node;
        via[other] = e;
        order.push_back(other);
      }
    }
  }
  for (auto node = order.rbegin(); node != order.rend(); ++node) {
    if (!is_odd_[*node] || parent[*node] == kNone) continue;
    is_odd_[*node] = false;
    is_odd_[parent[*node]] = !is_odd_[parent[*node]];
    used_.push_back(via[*node]);
  }
}

std::vector<Edge> spanning_edges(std::size_t nodes, const std::vector<Edge>& edges) {
  std::vector<Index> joined(nodes);
  for (Index i = 0; i < nodes; ++i) joined[i] = i;
  const auto find = [&](Index i) {
    while (joined[i] != i) i = joined[i] = joined[joined[i]];
    return i;
  };
  std::vector<Edge> taken;
  for (const Edge& edge : edges) {
    const Index a = find(edge.first), b = find(edge.second);
    if (a == b) continue;
    joined[a] = b;
    taken.push_back(edge);
  }
  return taken;
}

}  // namespace qmorph::layers
