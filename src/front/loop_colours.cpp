// SPDX-License-Identifier: GPL-2.0-or-later
#include "front/loop_colours.hpp"

namespace qmorph::front {

void LoopColours::set_label(Index v, unsigned system, unsigned colour) { labels_.set(v, 1 + 2 * system + colour); }

void LoopColours::colour_loop(Index h) {
  const auto system = unsigned(systems_.size());
  unsigned colour = 0;
  Index e = h;
  do {
    set_label(mesh_.origin(e), system, colour);
    colour ^= 1;
    e = front_.next(e);
  } while (e != h);
  systems_.push_back({system, 0, colour == 1});
}

LoopColours::Root LoopColours::root(Index v) const {
  unsigned system = (labels_[v] - 1) / 2, colour = (labels_[v] - 1) & 1;
  while (systems_[system].parent != system) {
    colour ^= systems_[system].flip;
    system = systems_[system].parent;
  }
  return {system, colour};
}

bool LoopColours::may_join(Index a, Index b) const {
  if (!is_coloured(a) || !is_coloured(b)) return true;
  const Root p = root(a), q = root(b);
  return p.system != q.system || p.colour != q.colour;
}

void LoopColours::colour_opposite(Index v, Index u) {
  const Root r = root(u);
  set_label(v, r.system, r.colour ^ 1);
}

void LoopColours::colour_same(Index v, Index u) {
  const Root r = root(u);
  set_label(v, r.system, r.colour);
}

void LoopColours::join(Index a, Index b, Index front_edge) {
  const Root p = root(a), q = root(b);
  if (p.system == q.system) return;
  if (systems_[p.system].odd || systems_[q.system].odd) {
    if (front_edge != kNone) colour_loop(front_edge);
    return;
  }
  // The larger number goes below the smaller; the edge a-b must have ends of different colours.
  const auto [upper, lower] = std::minmax(p.system, q.system);
  systems_[lower].parent = upper;
  systems_[lower].flip = p.colour == q.colour ? 1 : 0;
}

}  // namespace qmorph::front
