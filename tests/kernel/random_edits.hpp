// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Random legal edits of a mesh, each with what it must do to counts and boundary.

#include <array>
#include <map>
#include <optional>
#include <set>

#include "kernel/fixture.hpp"
#include "topology/edits.hpp"

namespace qmorph::test {

class RandomEdits {
 public:
  static inline const std::array<std::string, 8> kNames = {"split_edge", "split_face", "join_faces", "flip",
                                                           "collapse",   "open_quad",  "pillow",     "make_face"};

  RandomEdits(Mesh& mesh, Rng& rng) : mesh_(mesh), rng_(rng), boundary_(boundary_of(mesh)), expected_(count(mesh)) {}

  /// One edit. False if the element drawn did not allow the edit drawn.
  bool step() {
    kind_ = rng_.below(kNames.size());
    if (count(mesh_).faces > 150 && (kind_ == 5 || kind_ == 6)) kind_ = 4;  // keep meshes small
    const bool done = edit();
    done_[kind_] += done;
    return done;
  }

  /// What is not as it should be after the last edit; "" if all is well.
  std::string wrong() const {
    if (const std::string text = defect(mesh_, false); !text.empty()) return text;
    if (count(mesh_) != expected_) return "not the number of elements that the edit should leave";
    Edges expected = boundary_;
    std::sort(expected.begin(), expected.end());
    if (boundary_of(mesh_) != expected) return "the boundary changed";
    return "";
  }
  std::string last() const { return kNames[kind_]; }
  int done(std::size_t kind) const { return done_[kind]; }

 private:
  bool edit() {
    switch (kind_) {
      case 0:
        return split_edge();
      case 1:
        return split_face();
      case 2:
        return join_faces();
      case 3:
        return flip();
      case 4:
        return collapse();
      case 5:
        return open_quad();
      case 6:
        return pillow();
      default:
        return make_face();
    }
  }

  Index some_half_edge() {
    for (;;) {
      const auto h = Index(rng_.below(mesh_.half_edge_slots()));
      if (mesh_.is_live_half_edge(h)) return h;
    }
  }
  Vec2 near(Index v) { return mesh_.point(v) + Vec2(rng_.between(-0.1, 0.1), rng_.between(-0.1, 0.1)); }

  /// With the faces of five that result cut in two.
  bool split_edge() {
    const Index h = some_half_edge(), a = mesh_.origin(h), b = mesh_.target(h);
    const bool outside = mesh_.is_boundary_edge(h);
    const Index m = mesh_.split_edge(h, near(a));
    expected_.nodes += 1, expected_.edges += 1;
    if (outside) {
      const auto it = std::find_if(boundary_.begin(), boundary_.end(),
                                   [&](const auto& e) { return std::minmax(e.first, e.second) == std::minmax(a, b); });
      const auto [from, to] = *it;
      *it = {from, m};
      boundary_.emplace_back(m, to);
    }
    for (Index side : std::array<Index, 2>{mesh_.out(m), mesh_.rotate_ccw(mesh_.out(m))})
      if (mesh_.face(side) != kNone && mesh_.degree(mesh_.face(side)) == 5) {
        Index across = mesh_.next(mesh_.next(side));
        if (mesh_.find(m, mesh_.origin(across)) != kNone) across = mesh_.next(across);  // cut to there already
        mesh_.split_face(side, across);
        expected_.edges += 1, expected_.faces += 1;
      }
    return true;
  }

  bool split_face() {
    const Index h = some_half_edge(), across = mesh_.next(mesh_.next(h));
    if (!mesh_.is_quad(mesh_.face(h)) || mesh_.find(mesh_.origin(h), mesh_.origin(across)) != kNone) return false;
    mesh_.split_face(h, across);
    expected_.edges += 1, expected_.faces += 1;
    return true;
  }

  /// Two triangles become a quad; a triangle and a quad are cut again, in another place.
  bool join_faces() {
    const Index h = some_half_edge(), f = mesh_.face(h), g = mesh_.face(Mesh::twin(h));
    if (f == kNone || g == kNone || mesh_.degree(f) + mesh_.degree(g) > 7) return false;
    if (shared_edges(f, g) != 1) return false;
    if (mesh_.valence(mesh_.origin(h)) < 3 || mesh_.valence(mesh_.target(h)) < 3) return false;
    const Index from = mesh_.degree(f) + mesh_.degree(g) == 7 ? mesh_.next(h) : kNone;
    if (from == kNone) {
      mesh_.join_faces(h);
      expected_.edges -= 1, expected_.faces -= 1;
      return true;
    }
    mesh_.begin();
    mesh_.join_faces(h);
    const Index to = mesh_.next(mesh_.next(mesh_.next(from)));
    if (mesh_.find(mesh_.origin(from), mesh_.origin(to)) != kNone) return mesh_.rollback(), false;
    mesh_.split_face(from, to);
    return mesh_.commit(), true;
  }

  int shared_edges(Index f, Index g) const {
    int shared = 0;
    Index e = mesh_.half_edge(f);
    for (Index i = 0; i < mesh_.degree(f); ++i, e = mesh_.next(e)) shared += mesh_.face(Mesh::twin(e)) == g;
    return shared;
  }

  bool flip() {
    const Index h = some_half_edge();
    if (!mesh_.can_flip(h)) return false;
    return mesh_.flip(h), true;
  }

  bool collapse() {
    const Index h = some_half_edge();
    if (!mesh_.can_collapse(h)) return false;
    const int triangles = mesh_.is_triangle(mesh_.face(h)) + mesh_.is_triangle(mesh_.face(Mesh::twin(h)));
    mesh_.collapse(h);
    expected_.nodes -= 1, expected_.edges -= 1 + triangles, expected_.faces -= triangles;
    return true;
  }

  bool open_quad() {
    const Index h = some_half_edge();
    Index k = h;
    for (int turns = rng_.range(2, 4); turns > 0; --turns) {
      if (mesh_.face(k) == kNone) return false;
      k = mesh_.rotate_ccw(k);
      if (k == h) return false;
    }
    if (mesh_.target(h) == mesh_.target(k)) return false;
    mesh_.open_quad(h, k, near(mesh_.origin(h)));
    expected_.nodes += 1, expected_.edges += 2, expected_.faces += 1;
    return true;
  }

  bool pillow() {
    const Index f = mesh_.face(some_half_edge());
    if (f == kNone) return false;
    std::vector<Index> copies;
    if (!topology::pillow(mesh_, topology::grow(mesh_, {f}, int(rng_.below(2))), copies)) return false;
    const auto n = int(copies.size());
    expected_.nodes += n, expected_.edges += 2 * n, expected_.faces += n;
    return true;
  }

  /// The triangles around a node of valence 3 or 4 become one face.
  bool make_face() {
    for (int tries = 0; tries < 20; ++tries)
      if (make_face_around(mesh_.origin(some_half_edge()))) return true;
    return false;
  }

  bool make_face_around(Index v) {
    if (mesh_.is_boundary(v) || mesh_.valence(v) < 3 || mesh_.valence(v) > 4) return false;
    std::vector<Index> ring, inside;
    Index h = mesh_.out(v);
    do {
      if (!mesh_.is_triangle(mesh_.face(h))) return false;
      ring.push_back(mesh_.next(h)), inside.push_back(mesh_.face(h));
      h = mesh_.rotate_ccw(h);
    } while (h != mesh_.out(v));
    mesh_.make_face(ring, inside);
    const auto n = int(ring.size());
    expected_.nodes -= 1, expected_.edges -= n, expected_.faces -= n - 1;
    return true;
  }

  Mesh& mesh_;
  Rng& rng_;
  Edges boundary_;
  Counts expected_;
  std::size_t kind_ = 0;
  std::array<int, 8> done_{};
};

/// What is wrong with a mesh as a list of faces, by counting alone: a second opinion on `find_defects`. "" if nothing.
/// Every face has three or four different nodes, every side occurs once, and the faces at a node are one fan.
inline std::string wrong_with(const Polygons& faces) {
  std::set<std::pair<Index, Index>> sides;
  std::map<Index, std::map<Index, Index>> turns;  // at a node, from the neighbour before it to the one after
  for (const auto& face : faces) {
    const std::size_t n = face.size();
    if (n != 3 && n != 4) return "a face of " + std::to_string(n);
    if (std::set(face.begin(), face.end()).size() != n) return "a face with a node twice";
    for (std::size_t i = 0; i < n; ++i) {
      const Index before = face[(i + n - 1) % n], at = face[i], after = face[(i + 1) % n];
      if (!sides.emplace(at, after).second) return "a side twice";
      turns[at][after] = before;  // counter-clockwise around the node
    }
  }
  for (const auto& [node, turn] : turns) {
    Index start = turn.begin()->first;
    for (const auto& [after, before] : turn)  // the fan of a boundary node starts at the side without a twin
      if (!sides.contains({after, node})) start = after;
    std::size_t length = 0;
    Index at = start;
    while (turn.contains(at) && length <= turn.size()) {
      at = turn.at(at), ++length;
      if (at == start) break;
    }
    if (length != turn.size()) return "several fans at node " + std::to_string(node);
  }
  return "";
}

}  // namespace qmorph::test
