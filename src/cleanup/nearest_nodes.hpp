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
  /// The node from which v was reached; kNone for the first.
  Index before(Index v) const { return before_[v]; }

 private:
  const kernel::Mesh& mesh_;
  std::vector<Index> found_;  ///< in the order in which they were reached
  std::size_t left_ = 0;      ///< of `found_`: from here on nobody has looked
  std::vector<Index> before_;
  kernel::MarkSet reached_;
};

}  // namespace qmorph::cleanup
