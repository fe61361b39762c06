// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A set of indices that is emptied in constant time: for small sets that are filled again and again.

#include <utility>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::kernel {

class MarkSet {
 public:
  void clear() {
    if (++round_ != 0) return;
    rounds_.assign(rounds_.size(), 0);  // marks of 2^32 rounds ago would look new
    round_ = 1;
  }
  /// True if i was not in the set.
  bool insert(Index i) {
    if (i >= rounds_.size()) rounds_.resize(std::size_t(i) + 1 + i / 2, 0);
    return std::exchange(rounds_[i], round_) != round_;
  }
  void erase(Index i) {
    if (i < rounds_.size()) rounds_[i] = 0;
  }
  bool contains(Index i) const { return i < rounds_.size() && rounds_[i] == round_; }

 private:
  std::vector<unsigned> rounds_;  ///< by index: the round in which it was put in last
  unsigned round_ = 1;
};

}  // namespace qmorph::kernel
