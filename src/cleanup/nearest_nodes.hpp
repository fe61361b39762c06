// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Nodes around one, nearest first, and the ways to them.

#include <vector>

#include "kernel/mark_set.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

/// A walk in all directions at once, edge by edge, through free nodes. It goes no further than it is asked to.
class NearestNodes {
 public:
  explicit NearestNodes(const kernel::Mesh& mesh) : mesh_(mesh) {}

  /// Begins at v.
  void start(Index v);
  /// The next node, or kNone if `most` nodes have been looked at, or all.
  Index next(std::size_t most);
  /// Edges at the node that was next, if it is free; 0 if it is not.
  int edges() const { return edges_; }
  /// The node that was next, the one from which it was reached, and so on to the first that `is_end` holds for, which
  /// must hold for the node where the walk began.
  template <class Test>
  void way_back(std::vector<Index>& way, const Test& is_end) const {
    Found at = found_[left_ - 1];
    for (way.assign(1, at.node); !is_end(at.node); way.push_back(at.node)) at = found_[at.from];
  }

 private:
  const kernel::Mesh& mesh_;
  struct Found {
    Index node, from;  ///< `from`: the place in `found_` of the node from which this one was reached
  };
  std::vector<Found> found_;  ///< in the order in which they were reached; with room for more
  std::size_t count_ = 0;     ///< of `found_`
  std::size_t left_ = 0;      ///< of those: from here on nobody has looked
  kernel::MarkSet reached_;
  int edges_ = 0;
};

}  // namespace qmorph::cleanup
