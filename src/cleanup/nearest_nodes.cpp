// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/nearest_nodes.hpp"

namespace qmorph::cleanup {

void NearestNodes::start(Index v) {
  if (before_.size() < mesh_.vertex_slots()) before_.resize(mesh_.vertex_slots(), kNone);
  found_.assign(1, v);
  left_ = 0;
  reached_.clear();
  reached_.insert(v);
  before_[v] = kNone;
}

Index NearestNodes::next(std::size_t most) {
  if (left_ == found_.size() || left_ >= most) return kNone;
  const Index v = found_[left_++];
  if (!mesh_.is_free(v)) return v;
  for (Index h : mesh_.around(v)) {
    const Index u = mesh_.target(h);
    if (!reached_.insert(u)) continue;
    before_[u] = v;
    found_.push_back(u);
  }
  return v;
}

}  // namespace qmorph::cleanup
