// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <unordered_map>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::chart {

/// Numbers 0, 1, ... for some of many rows, found by row, in memory and time that grow with how many are numbered.
class LocalNumbers {
 public:
  /// `all`: how many rows there are.
  LocalNumbers(const std::vector<Index>& rows, std::size_t all) {
    constexpr std::size_t kMany = 16;
    if (rows.size() * kMany > all)
      dense_.assign(all, kNone);
    else
      sparse_.reserve(rows.size());
    for (Index k = 0; k < rows.size(); ++k) {
      if (dense_.empty())
        sparse_.emplace(rows[k], k);
      else
        dense_[rows[k]] = k;
    }
  }
  /// kNone if the row is none of them.
  Index operator[](Index row) const {
    if (!dense_.empty()) return dense_[row];
    const auto found = sparse_.find(row);
    return found == sparse_.end() ? kNone : found->second;
  }

 private:
  std::vector<Index> dense_;
  std::unordered_map<Index, Index> sparse_;
};

}  // namespace qmorph::chart
