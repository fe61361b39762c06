// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/cavity.hpp"

namespace qmorph::cleanup {

using kernel::Mesh;

void Cavity::begin() {
  faces_.clear(), outline_.clear(), inner_.clear();
  traced_ = 0;
  if (leaving_.size() < mesh_.vertex_slots()) leaving_.resize(mesh_.vertex_slots(), kNone);
  inside_.clear();
}

bool Cavity::add(Index f) {
  if (!mesh_.is_quad(f)) return false;
  if (inside_.insert(f)) faces_.push_back(f);
  return true;
}

bool Cavity::add_around(Index v) {
  for (Index h : mesh_.around(v))
    if (mesh_.face(h) != kNone && !add(mesh_.face(h))) return false;
  return true;
}

bool Cavity::start(Index v) {
  begin();
  return mesh_.is_free(v) && add_around(v) && make_convex();
}

bool Cavity::start_with(const std::vector<Index>& faces) {
  begin();
  for (Index f : faces)
    if (!add(f)) return false;
  return trace();
}

bool Cavity::start_with_all() {
  std::vector<Index> all;
  for (Index f = 0; f < mesh_.face_slots(); ++f)
    if (mesh_.is_live_face(f)) all.push_back(f);
  return start_with(all);
}

/// Whether what is asked for holds for a face around v.
template <class Test>
bool Cavity::any_around(Index v, const Test& test) const {
  for (Index h : mesh_.around(v))
    if (test(mesh_.face(h))) return true;
  return false;
}

bool Cavity::is_inside(Index v) const {
  return !any_around(v, [&](Index f) { return !contains(f); });
}

bool Cavity::touches(Index v) const {
  return any_around(v, [&](Index f) { return contains(f); });
}

bool Cavity::add_nodes(const std::vector<Index>& nodes, std::size_t most) {
  const std::size_t kept = faces_.size();
  kept_outline_ = outline_, kept_inner_ = inner_, kept_outer_ = outer_;
  bool added = true;
  for (Index v : nodes) added = added && add_around(v);
  if (added && faces_.size() <= most && make_convex(most) && faces_.size() <= most) return true;
  for (std::size_t k = kept; k < faces_.size(); ++k) inside_.erase(faces_[k]);
  faces_.resize(kept);
  traced_ = kept;
  outline_ = kept_outline_, inner_ = kept_inner_, outer_ = kept_outer_;
  return false;
}

bool Cavity::make_convex(std::size_t most) {
  constexpr int kMostRounds = 40;
  for (int i = 0; i < kMostRounds; ++i) {
    if (!trace()) return false;
    const std::size_t before = faces_.size();
    for (std::size_t k = 0; k < outline_.size(); ++k) {
      const Index v = mesh_.origin(outline_[k]);
      if (outer_[k] == 2 && mesh_.is_free(v) && !add_around(v)) return false;
    }
    if (faces_.size() == before) return true;
    if (faces_.size() > most) return false;
  }
  return false;
}

template <class Visit>
void Cavity::for_new_sides(const Visit& visit) const {
  for (std::size_t k = traced_; k < faces_.size(); ++k) {
    Index h = mesh_.half_edge(faces_[k]);
    for (int i = 0; i < 4; ++i, h = mesh_.next(h)) visit(h);
  }
}

/// The outline consists of sides of quads inside with no such quad behind them; they are sides of the previous outline
/// or of the quads that were added since. False if they are not one loop that passes each node once.
bool Cavity::trace_outline() {
  std::swap(outline_, old_outline_);
  outline_.clear();
  std::size_t count = 0;
  Index first = kNone;
  const auto take_side = [&](Index h) {
    if (contains(mesh_.face(Mesh::twin(h)))) return;
    leaving_[mesh_.origin(h)] = first = h;
    ++count;
  };
  for (Index h : old_outline_) take_side(h);
  for_new_sides(take_side);
  if (first == kNone) return false;
  Index h = first;
  do {
    if (outline_.size() == count) return false;
    outline_.push_back(h);
    h = leaving_[mesh_.target(h)];
  } while (h != first);
  return outline_.size() == count;  // fewer: it touches itself, or has a hole
}

void Cavity::count_outer_edges() {
  outer_.clear();
  for (std::size_t k = 0; k < outline_.size(); ++k) {
    const Index before = outline_[k == 0 ? outline_.size() - 1 : k - 1];
    int outside = 1;
    for (Index e = Mesh::twin(before); e != outline_[k]; e = mesh_.rotate_ccw(e)) ++outside;
    outer_.push_back(outside);
  }
}

/// Nodes that have left the outline, or never were on it. False if one is not free.
bool Cavity::take_inner_nodes() {
  taken_.clear();
  for (Index h : outline_) taken_.insert(mesh_.origin(h));
  bool are_free = true;
  const auto take_node = [&](Index h) {
    const Index v = mesh_.origin(h);
    if (!taken_.insert(v)) return;
    are_free = are_free && mesh_.is_free(v);
    inner_.push_back(v);
  };
  for (Index h : old_outline_) take_node(h);
  for_new_sides(take_node);
  return are_free;
}

/// Euler's formula, V - E + F = 1. Two sides of quads make an edge, but on the outline one does.
bool Cavity::is_disc() const {
  const std::size_t nodes = inner_.size() + outline_.size(), edges = (4 * faces_.size() + outline_.size()) / 2;
  return nodes + faces_.size() == edges + 1;
}

/// Finds outline and inner nodes, from those before the last faces were added. False if the quads are no disc or an
/// inner node is not free.
bool Cavity::trace() {
  if (!trace_outline()) return false;
  count_outer_edges();
  if (!take_inner_nodes()) return false;
  traced_ = faces_.size();
  return is_disc();
}

}  // namespace qmorph::cleanup
