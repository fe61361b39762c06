// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/refused.hpp"

namespace qmorph::cleanup {

void Refused::set(std::vector<Index>& when, Index v, Index now) {
  if (v >= when.size()) when.resize(std::size_t(v) + 1 + v / 2, 0);
  when[v] = now;
}

void Refused::note_change() {
  ++changes_;
  mesh_.for_edited_vertices([&](Index v) { set(changed_, v, changes_); });
  // A node of the boundary gets another edge without being edited.
  mesh_.for_edited_half_edges([&](Index h) {
    if (mesh_.is_live_half_edge(h)) set(changed_, mesh_.origin(h), changes_);
  });
}

void Refused::note(Index v) { set(nothing_found_, v, changes_ + 1); }

bool Refused::holds(Index v, std::size_t most) {
  const Index then = v < nothing_found_.size() ? nothing_found_[v] : 0;
  if (then == 0) return false;
  if (then == changes_ + 1) return true;
  nearest_.start(v);
  for (Index u; (u = nearest_.next(most)) != kNone;)
    if (u < changed_.size() && changed_[u] >= then) return false;
  return true;
}

}  // namespace qmorph::cleanup
