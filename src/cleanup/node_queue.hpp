// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Nodes that wait to be looked at, first come first served, each at most once at a time.

#include <deque>
#include <vector>

#include "qmorph/patch.hpp"

namespace qmorph::cleanup {

class NodeQueue {
 public:
  bool empty() const { return waiting_.empty(); }

  void push(Index v) {
    if (v >= queued_.size()) queued_.resize(v + 1 + v / 2, 0);
    if (queued_[v]) return;
    queued_[v] = 1;
    waiting_.push_back(v);
  }

  Index pop() {
    const Index v = waiting_.front();
    waiting_.pop_front();
    queued_[v] = 0;
    return v;
  }

 private:
  std::deque<Index> waiting_;
  std::vector<char> queued_;  ///< by node
};

}  // namespace qmorph::cleanup
