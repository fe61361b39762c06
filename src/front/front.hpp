// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The advancing front: which half-edges are on it, in which state, and which comes next.
///
/// The mesh itself decides what the front is: a half-edge with a triangle ahead and, behind it, the outside or a
/// quad. So there is no list of front edges that could go stale; kept beside the mesh are only levels,
/// the colours of loops and a queue.

#include <cstdint>
#include <vector>

#include "front/decisions.hpp"
#include "front/logged_column.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"

namespace qmorph::front {

using kernel::Mesh;

/// State of a front edge: one bit for each end that is a corner. Thesis 2.2.2.
struct State {
  bool left = false;   ///< at origin(h)
  bool right = false;  ///< at target(h)
  int corners() const { return int(left) + int(right); }
};

/// A front edge, its neighbours on the front and its state, looked up once.
struct Base {
  Index h = kNone, before = kNone, after = kNone;
  State state;
};

class Front {
 public:
  /// `decisions`: is told what the constants have decided; may be null.
  Front(const Mesh& mesh, const FrontOptions& options, Decisions* decisions = nullptr);

  // --- membership and neighbours: questions to the mesh -------------------------------------------
  bool contains(Index h) const {
    return mesh_.is_triangle(mesh_.face(h)) && !mesh_.is_triangle(mesh_.face(Mesh::twin(h)));
  }
  /// Calls visit(incoming, outgoing) for the front edges on both sides of each wedge of triangles at v.
  template <class Visit>
  void for_wedges_at(Index v, const Visit& visit) const {
    Index outgoing = kNone, first_incoming = kNone;
    bool was_triangle = mesh_.is_triangle(mesh_.face(Mesh::twin(mesh_.out(v))));
    for (Index h : mesh_.around(v)) {
      const bool is_triangle = mesh_.is_triangle(mesh_.face(h));
      if (is_triangle && !was_triangle) {
        outgoing = h;
      } else if (!is_triangle && was_triangle) {
        if (outgoing == kNone)
          first_incoming = Mesh::twin(h);  // the way began inside its wedge
        else
          visit(Mesh::twin(h), outgoing);
      }
      was_triangle = is_triangle;
    }
    if (first_incoming != kNone) visit(first_incoming, outgoing);
  }
  /// The front edge that follows (precedes) h through the triangles ahead. O(valence).
  Index next(Index h) const {
    Index e = mesh_.next(h);
    while (mesh_.is_triangle(mesh_.face(Mesh::twin(e)))) e = mesh_.rotate_cw(e);
    return e;
  }
  Index prev(Index h) const {
    Index e = mesh_.prev(h);
    while (mesh_.is_triangle(mesh_.face(Mesh::twin(e)))) e = mesh_.prev(Mesh::twin(e));
    return e;
  }
  /// Angle through the triangles ahead between h and the front edge before (after) it, in (0, 2 pi].
  double angle_left(Index h) const { return angle_between(prev(h), h); }
  double angle_right(Index h) const { return angle_between(h, next(h)); }
  double angle_between(Index incoming, Index outgoing) const;
  /// Whether angle_between() is below `limit`. Usually it is far above, and then no arc tangent is needed.
  bool is_angle_below(Index incoming, Index outgoing, double limit) const;
  Base look_at(Index h) const;
  State state(Index h) const { return look_at(h).state; }
  /// The node between two front edges that follow each other is a corner. Thesis 2.2.2.
  bool is_corner(Index incoming, Index outgoing) const;

  // --- levels -----------------------------------------------------------------------------------------
  /// Rows between the front edge and the boundary. Thesis 2.2.3.
  unsigned level(Index h) const { return levels_[h]; }
  void set_level(Index h, unsigned level) { levels_.set(h, level); }
  LoggedColumn<unsigned>& levels() { return levels_; }

  // --- queue ------------------------------------------------------------------------------------------
  /// (Re)enters a front edge with its present state, level and length. `forced`: as if in state 1-1, once.
  void push(Index h, bool forced = false) { push(h, state(h), forced); }
  /// The same where the state is known.
  void push(Index h, State state, bool forced);
  /// The edge to process next, or kNone when the queue is empty. Thesis 3.5.2.
  Index pop();
  bool was_forced() const { return popped_forced_; }

 private:
  Index new_entry(Index h);

  /// The order of front edges, lowest first: level, then state, then length, in one number. Lengths of one class count
  /// as equal, so that neighbours come one after another, which is good for rows and for caches. Never 0.
  using Key = std::uint32_t;
  static Key key_of(unsigned level, unsigned priority, double length);

  const Mesh& mesh_;
  Decisions* decisions_;
  double corner_cosine_;
  LoggedColumn<unsigned> levels_;
  /// By half-edge: the key of the entry that counts, 0 for none; other entries are passed over.
  std::vector<Key> queued_;
  /// Half-edges of one key, the oldest first: entries that are linked from `first` to `last`.
  struct Line {
    Key key;
    Index first, last;
  };
  struct Entry {
    Index half_edge, next;
  };
  std::vector<Line> lines_;  ///< by key, the lowest last; none is empty
  std::vector<Entry> entries_;
  Index unused_ = kNone;  ///< the first of the entries that are in no line
  bool popped_forced_ = false;
};

}  // namespace qmorph::front
