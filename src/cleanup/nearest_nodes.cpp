// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/nearest_nodes.hpp"

namespace qmorph::cleanup {

void NearestNodes::start(Index v) {
  if (mark_.size() < mesh_.vertex_slots()) {
    mark_.resize(mesh_.vertex_slots(), 0);
    before_.resize(mesh_.vertex_slots(), kNone);
  }
  if (++round_ == 0) {
    mark_.assign(mark_.size(), 0);
    round_ = 1;
  }
  found_.assign(1, v);
  left_ = 0;
  mark_[v] = round_;
  before_[v] = kNone;
}

Index NearestNodes::next(std::size_t most) {
  if (left_ == found_.size() || left_ >= most) return kNone;
  const Index v = found_[left_++];
  if (!mesh_.is_free(v)) return v;
  Index h = mesh_.out(v);
  do {
    const Index u = mesh_.target(h);
    if (mark_[u] != round_) {
      mark_[u] = round_;
      before_[u] = v;
      found_.push_back(u);
    }
    h = mesh_.rotate_ccw(h);
  } while (h != mesh_.out(v));
  return v;
}

}  // namespace qmorph::cleanup
