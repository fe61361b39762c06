// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/nearest_nodes.hpp"

namespace qmorph::cleanup {

void NearestNodes::start(Index v) {
  if (found_.empty()) found_.resize(1);
  found_[0] = {v, 0};
  count_ = 1, left_ = 0;
  reached_.clear();
  reached_.insert(v);
}

Index NearestNodes::next(std::size_t most) {
  edges_ = 0;
  if (left_ == count_ || left_ >= most) return kNone;
  const auto place = Index(left_++);
  const Index v = found_[place].node;
  // The walk waits for memory most of the time: what it needs soon is asked for now.
  constexpr std::size_t kSoon = 4;
  if (left_ + kSoon < count_) mesh_.prefetch_edge_at(found_[left_ + kSoon].node);
  if (!mesh_.is_free(v)) return v;
  for (Index h : mesh_.around(v)) {
    // Not `if`: half of the neighbours are new, and no processor can predict which.
    if (count_ == found_.size()) found_.resize(2 * count_);
    const Index u = mesh_.target(h);
    mesh_.prefetch_node(u);
    found_[count_] = {u, place};
    count_ += reached_.insert(u);
    ++edges_;
  }
  return v;
}

}  // namespace qmorph::cleanup
