// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Perfect matching of least cost in a complete graph.

#include <cstdint>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::parity {

using Cost = std::int64_t;

/// A symmetric table of costs between `size` nodes.
class CostTable {
 public:
  explicit CostTable(std::size_t size) : size_(size), cost_(size * size, 0) {}
  std::size_t size() const { return size_; }
  Cost operator()(std::size_t i, std::size_t j) const { return cost_[i * size_ + j]; }
  void set(std::size_t i, std::size_t j, Cost cost) { cost_[i * size_ + j] = cost_[j * size_ + i] = cost; }

 private:
  std::size_t size_;
  std::vector<Cost> cost_;
};

/// The partner of each node, so that the sum of the pairs' costs is least. Exact: Edmonds' primal-dual algorithm with
/// blossoms [J. Edmonds, Maximum matching and a polyhedron with 0,1-vertices, 1965].
/// Preconditions: an even number of nodes; 0 <= cost <= 2^60.
/// Cost: n^3 at best, n^4 at worst; 0.1 s for 200 nodes, more than enough where nodes are surfaces with an odd
/// boundary.
std::vector<Index> cheapest_matching(const CostTable& costs);

}  // namespace qmorph::parity
