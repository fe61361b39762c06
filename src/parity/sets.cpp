// SPDX-License-Identifier: GPL-2.0-or-later
#include "parity/sets.hpp"

#include <algorithm>
#include <numeric>

namespace qmorph::parity {

Sets::Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

Index Sets::root(Index i) {
  while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
  return i;
}

void Sets::unite(Index i, Index j) {
  i = root(i), j = root(j);
  parent_[std::max(i, j)] = std::min(i, j);
}

std::vector<std::vector<Index>> Sets::members() {
  std::vector<std::vector<Index>> sets(parent_.size());
  for (Index i = 0; i < parent_.size(); ++i) sets[root(i)].push_back(i);
  return sets;
}

}  // namespace qmorph::parity
