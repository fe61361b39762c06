// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <vector>

#include "topology/edits.hpp"

namespace qmorph {
namespace {

using kernel::Mesh;

/// Gives each triangle one of its sides for the diagonal of its cell, from a first one to its neighbours and on.
class Diagonals {
 public:
  explicit Diagonals(const Mesh& mesh) : mesh_(mesh), diagonal_(mesh.face_slots(), kNone) {}

  /// With `first` for the diagonal of its triangle. False if two triangles do not agree.
  bool spread_from(Index first) {
    std::fill(diagonal_.begin(), diagonal_.end(), kNone);
    clear_.clear();
    doubtful_.clear();
    if (!set(first)) return false;
    // Neighbours that are plain come first, since they may settle what is doubtful from elsewhere.
    while (!clear_.empty() || !doubtful_.empty()) {
      auto& steps = clear_.empty() ? doubtful_ : clear_;
      const Index diagonal = steps.front();
      steps.pop_front();
      if (diagonal_[mesh_.face(diagonal)] == kNone && !set(diagonal)) return false;
    }
    return true;
  }

  Index operator[](Index f) const { return diagonal_[f]; }

 private:
  /// Both triangles of the diagonal.
  bool set(Index diagonal) {
    for (Index h : Mesh::halves_of(diagonal)) {
      const Index f = mesh_.face(h);
      if (f == kNone || !mesh_.is_triangle(f) || (diagonal_[f] != kNone && diagonal_[f] != h)) return false;
      diagonal_[f] = h;
    }
    for (Index h : Mesh::halves_of(diagonal)) {
      look_beyond(mesh_.next(h));
      look_beyond(mesh_.prev(h));
    }
    return true;
  }

  /// From a side of a cell to the triangle beyond. That has its third corner where the lattice of the triangle here
  /// goes on from one end of the side, or from the other, and its diagonal at the other of the two.
  void look_beyond(Index side) {
    const Index out = Mesh::twin(side), f = mesh_.face(out);
    if (f == kNone || diagonal_[f] != kNone) return;
    const Index here = diagonal_[mesh_.face(side)];
    const Vec2 along = mesh_.vector(out);
    // What leads from the side into the triangle here, along its other side.
    const Vec2 inwards = mesh_.next(side) == here ? -mesh_.vector(mesh_.prev(side)) : mesh_.vector(mesh_.next(side));
    const Vec2 beyond = mesh_.vector(mesh_.next(out)) + along;  // from where `out` begins to the third corner
    // beyond = share * along - so_much * inwards
    const double share = cross(beyond, inwards) / cross(along, inwards);
    const Index diagonal = share < 0.5 ? mesh_.next(out) : mesh_.prev(out);
    constexpr double kClear = 0.25;
    (std::abs(share - 0.5) > kClear ? clear_ : doubtful_).push_back(diagonal);
  }

  const Mesh& mesh_;
  std::vector<Index> diagonal_;         ///< by face
  std::deque<Index> clear_, doubtful_;  ///< to be set next
};

/// Nodes with cells all around them have four.
bool is_regular(const Mesh& cells) {
  for (Index v = 0; v < cells.vertex_slots(); ++v)
    if (cells.is_live_vertex(v) && !cells.is_boundary(v) && cells.valence(v) != 4) return false;
  return true;
}

std::size_t count_inner_nodes(const Mesh& mesh) {
  std::size_t count = 0;
  for (Index v = 0; v < mesh.vertex_slots(); ++v) count += mesh.is_live_vertex(v) && !mesh.is_boundary(v);
  return count;
}

std::optional<Mesh> join_pairs(const Mesh& triangles, const Diagonals& diagonals) {
  Mesh cells = triangles;
  for (Index f = 0; f < triangles.face_slots(); ++f) {
    if (!triangles.is_live_face(f)) continue;
    const Index h = diagonals[f];
    if (h == kNone) return {};
    if (h < Mesh::twin(h)) cells.join_faces(h);
  }
  if (!is_regular(cells)) return {};
  return cells;
}

}  // namespace

std::optional<Mesh> pair_as_grid(const Mesh& triangles) {
  constexpr std::size_t kEnough = 9;  // nodes inside 4 by 4 cells
  Index first = 0;
  while (first < triangles.face_slots() && !triangles.is_live_face(first)) ++first;
  if (first == triangles.face_slots() || count_inner_nodes(triangles) < kEnough) return {};
  Diagonals diagonals(triangles);
  std::optional<Mesh> best;
  for (Index h : triangles.sides_of(first)) {
    if (!diagonals.spread_from(h)) continue;
    auto cells = join_pairs(triangles, diagonals);
    if (cells && (!best || topology::smallest_sine(*cells) > topology::smallest_sine(*best))) best = std::move(cells);
  }
  return best;
}

bool is_good_grid(const Mesh& triangles) {
  const auto cells = pair_as_grid(triangles);
  return cells && topology::smallest_sine(*cells) >= kPoorestCell;
}

bool is_unstretched_grid(const Mesh& triangles) {
  constexpr double kStretched = 3;
  const auto cells = pair_as_grid(triangles);
  if (!cells || topology::smallest_sine(*cells) < kPoorestCell) return false;
  for (Index f = 0; f < cells->face_slots(); ++f) {
    if (!cells->is_live_face(f)) continue;
    double shortest = std::numeric_limits<double>::infinity(), longest = 0;
    for (Index h : cells->sides_of(f))
      shortest = std::min(shortest, cells->length(h)), longest = std::max(longest, cells->length(h));
    if (longest >= kStretched * shortest) return false;
  }
  return true;
}

}  // namespace qmorph
