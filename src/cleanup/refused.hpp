// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Nodes at which nothing was found, so that nobody looks again where nothing has changed since.

#include <cstddef>
#include <vector>

#include "cleanup/nearest_nodes.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::cleanup {

class Refused {
 public:
  explicit Refused(const kernel::Mesh& mesh) : mesh_(mesh), nearest_(mesh) {}

  /// The mesh's last transaction was kept.
  void note_change();
  /// Nothing was found at v.
  void note(Index v);
  /// Nothing was found at v, and none of the `most` nodes nearest to it has moved or got another edge since. Cost:
  /// those nodes, and only if nothing was found.
  bool holds(Index v, std::size_t most);

 private:
  static void set(std::vector<Index>& when, Index v, Index now);

  const kernel::Mesh& mesh_;
  NearestNodes nearest_;
  Index changes_ = 0;                 ///< transactions so far
  std::vector<Index> changed_;        ///< by node: in which transaction, the last one; 0: never
  std::vector<Index> nothing_found_;  ///< by node: how many transactions there had been, and one; 0: never
};

}  // namespace qmorph::cleanup
