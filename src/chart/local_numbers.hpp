// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::chart {

/// Numbers 0, 1, ... for some of many rows, found by row, in memory and time that grow with how many are numbered.
class LocalNumbers {
 public:
  /// `all`: how many rows there are.
  LocalNumbers(const std::vector<Index>& rows, std::size_t all) {
    constexpr std::size_t kMany = 16;
    if (rows.size() * kMany > all) {
      dense_.assign(all, kNone);
      for (Index k = 0; k < rows.size(); ++k) dense_[rows[k]] = k;
      return;
    }
    const int bits = int(std::bit_width(2 * rows.size()));
    shift_ -= bits;
    table_.assign(std::size_t(1) << bits, {kNone, kNone});
    for (Index k = 0; k < rows.size(); ++k) table_[slot_of(rows[k])] = {rows[k], k};
  }
  /// kNone if the row is none of them.
  Index operator[](Index row) const { return dense_.empty() ? table_[slot_of(row)].number : dense_[row]; }

 private:
  struct Entry {
    Index row, number;
  };
  /// Where the row is, or would be.
  std::size_t slot_of(Index row) const {
    constexpr std::uint64_t kSpread = 0x9E3779B97F4A7C15;  // 2^64 over the golden ratio
    std::size_t slot = (row * kSpread) >> shift_;
    while (table_[slot].row != row && table_[slot].row != kNone) slot = (slot + 1) & (table_.size() - 1);
    return slot;
  }

  std::vector<Index> dense_;
  std::vector<Entry> table_;  ///< a hash table, if `dense_` is empty
  int shift_ = 64;            ///< of a hash, that leaves a place in the table
};

}  // namespace qmorph::chart
