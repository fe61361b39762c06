// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How oddness is brought together along edges of a graph.

#include <utility>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::layers {

using Edge = std::pair<Index, Index>;

/// A tree for all nodes of a graph that edges join. Oddness goes along an edge from each node that has it to the one
/// above: a node with two of them is even, so that in the end only roots may be odd.
class Forest {
 public:
  /// \param roots all nodes: of a tree, the first of them is the root
  Forest(std::vector<bool> is_odd, const std::vector<Edge>& edges, const std::vector<Index>& roots);

  Index root(Index node) const { return root_[node]; }
  bool is_odd_tree(Index node) const { return is_odd_[root_[node]]; }
  /// Edges, by number, along which oddness goes.
  const std::vector<Index>& used() const { return used_; }

 private:
  std::vector<bool> is_odd_;  ///< by node, in the end
  std::vector<Index> root_;   ///< by node
  std::vector<Index> used_;
};

/// The edges of trees that join the same nodes as all of them do; each is taken unless those before it do that already.
std::vector<Edge> spanning_edges(std::size_t nodes, const std::vector<Edge>& edges);

}  // namespace qmorph::layers
