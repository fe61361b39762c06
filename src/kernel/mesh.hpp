// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Half-edge mesh of one region: faces of degree 3 and 4 (more for a moment, inside an operation), 32-bit indices,
/// every edit O(1) or O(valence). The outside is linked too, so that going round a vertex needs no
/// special case at the boundary.
///
/// Invariants, checked by `find_defects()`:
///   - the twin of h is h ^ 1; next(prev(h)) == h; target(h) == origin(next(h)); a face has one loop
///   - face(h) == kNone outside; a boundary vertex has exactly one outgoing boundary half-edge, and it is out(v)
///   - two vertices are joined by one edge at most, or by the two sides of a slit that is one edge long
///   - a dead element is reachable from nothing

#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "geometry/vec2.hpp"
#include "qmorph/patch.hpp"

namespace qmorph::kernel {

struct HalfEdge {
  Index origin = kNone, next = kNone, prev = kNone, face = kNone;
};
struct Vertex {
  Vec2 point = Vec2::Zero();
  Index out = kNone;   ///< an outgoing half-edge; the boundary one if there is one
  bool fixed = false;  ///< must neither move nor vanish
};
struct Face {
  Index half_edge = kNone;
  Index degree = 0;
};

class Mesh;

/// Half-edges that follow one another until the first comes again, for `for (Index h : mesh.around(v))`. The mesh must
/// not be edited meanwhile.
template <Index (Mesh::*following)(Index) const>
class Circle {
 public:
  class Iterator {
   public:
    Iterator(const Mesh& mesh, Index first) : mesh_(mesh), first_(first), at_(first) {}
    Index operator*() const { return at_; }
    Iterator& operator++() {
      at_ = (mesh_.*following)(at_);
      is_begin_ = false;
      return *this;
    }
    bool operator==(std::default_sentinel_t) const { return at_ == first_ && !is_begin_; }

   private:
    const Mesh& mesh_;
    Index first_, at_;
    bool is_begin_ = true;
  };
  Circle(const Mesh& mesh, Index first) : mesh_(mesh), first_(first) {}
  Iterator begin() const { return {mesh_, first_}; }
  std::default_sentinel_t end() const { return {}; }

 private:
  const Mesh& mesh_;
  Index first_;
};

class Mesh {
 public:
  Mesh() = default;
  /// From an indexed mesh that is a manifold with boundary, faces counter-clockwise. Side 3 * t + i of the triangles
  /// (from corner i of triangle t to the next) is not joined to another where `open` says so.
  Mesh(const std::vector<Vec2>& points, const std::vector<std::array<Index, 3>>& triangles,
       const std::vector<bool>& open = {});
  /// The same from quads and triangles; a triangle's last corner is kNone. Sides are 4 * f + i.
  Mesh(const std::vector<Vec2>& points, const std::vector<std::array<Index, 4>>& faces, const std::vector<bool>& open);

  // --- navigation -----------------------------------------------------------------------------------
  static Index twin(Index h) { return h ^ 1; }
  Index next(Index h) const { return half_edges_[h].next; }
  Index prev(Index h) const { return half_edges_[h].prev; }
  Index face(Index h) const { return half_edges_[h].face; }
  Index origin(Index h) const { return half_edges_[h].origin; }
  Index target(Index h) const { return half_edges_[h ^ 1].origin; }
  Index out(Index v) const { return vertices_[v].out; }
  Index half_edge(Index f) const { return faces_[f].half_edge; }
  Index degree(Index f) const { return faces_[f].degree; }
  const Vec2& point(Index v) const { return vertices_[v].point; }
  bool is_fixed(Index v) const { return vertices_[v].fixed; }
  /// May move, and vanish.
  bool is_free(Index v) const { return !is_fixed(v) && !is_boundary(v); }
  bool is_triangle(Index f) const { return f != kNone && faces_[f].degree == 3; }
  bool is_quad(Index f) const { return f != kNone && faces_[f].degree == 4; }
  bool is_boundary_edge(Index h) const { return face(h) == kNone || face(h ^ 1) == kNone; }
  bool is_boundary(Index v) const { return face(out(v)) == kNone; }
  /// The outgoing half-edge that follows h counter-clockwise around its origin.
  Index rotate_ccw(Index h) const { return twin(prev(h)); }
  Index rotate_cw(Index h) const { return next(twin(h)); }
  /// The half-edges that leave v, counter-clockwise; from the boundary's one, if there is one.
  Circle<&Mesh::rotate_ccw> around(Index v) const { return {*this, out(v)}; }
  /// The half-edges of a face, counter-clockwise.
  Circle<&Mesh::next> sides_of(Index f) const { return {*this, half_edge(f)}; }
  Vec2 vector(Index h) const { return point(target(h)) - point(origin(h)); }
  double length(Index h) const { return vector(h).norm(); }
  /// Calls visit(v) for the corners of a face, in their order.
  template <class Visit>
  void for_nodes_of(Index f, const Visit& visit) const {
    for (Index h : sides_of(f)) visit(origin(h));
  }
  /// Edges at v, or `kManyEdges` for so many and more: those who ask want to tell few, and walking round a fan each
  /// time is quadratic.
  Index valence(Index v) const;
  static constexpr Index kManyEdges = 64;
  /// Of all vertices, by vertex; 0 for dead ones.
  std::vector<Index> valences() const;
  /// The same for meshes that are the same to the bit, dead elements and all, so that the same edits have the same
  /// result; for others nearly always another one. Linear.
  std::uint64_t fingerprint() const;
  /// The half-edge from a to b, or kNone. O(valence).
  Index find(Index a, Index b) const;

  bool is_live_vertex(Index v) const { return vertices_[v].out != kNone; }
  bool is_live_face(Index f) const { return faces_[f].half_edge != kNone; }
  bool is_live_half_edge(Index h) const { return half_edges_[h].origin != kNone; }
  /// Sizes of the index ranges, dead elements included.
  Index vertex_slots() const { return Index(vertices_.size()); }
  Index half_edge_slots() const { return Index(half_edges_.size()); }
  Index face_slots() const { return Index(faces_.size()); }

  // --- geometry of elements -----------------------------------------------------------------------------
  /// All corners of the face are convex, by more than `kStraightSine` (`kDegenerateSine` in a triangle).
  bool is_valid_face(Index f) const;
  /// Every face around v is valid.
  bool is_valid_star(Index v) const;
  /// All corners of the face (of the faces around v) are convex and have a larger sine than this. Cheaper than the sine
  /// itself.
  bool is_above(Index f, double sine) const;
  bool is_star_above(Index v, double sine) const;
  /// Smallest sine of the face's corners, signed: its scaled Jacobian.
  double smallest_sine(Index f) const;
  /// The smallest of those of the faces around v.
  double smallest_sine_around(Index v) const;
  /// Mean length of the edges at v.
  double mean_edge(Index v) const;
  /// The same of all vertices, by vertex; 0 for dead ones. Each edge is measured once.
  std::vector<double> mean_edges() const;

  // --- edits ----------------------------------------------------------------------------------------
  void set_point(Index v, const Vec2& p) { edit_vertex(v).point = p; }
  void set_fixed(Index v);
  // A new vertex' point is taken by value: it may move the array that a reference points into.
  /// New vertex at p on the edge of h: h ends there. Both faces gain a side. Returns the vertex.
  Index split_edge(Index h, Vec2 p);
  /// New edge from origin(g) to origin(h), two half-edges of one face; it lies left of the face's part
  /// that starts with h. Returns the half-edge origin(g) -> origin(h).
  Index split_face(Index g, Index h);
  /// Removes the edge of h; its two faces become one, face(h). Returns a half-edge of it.
  Index join_faces(Index h);
  /// Turns the diagonal of two triangles. Precondition: `can_flip(h)`.
  void flip(Index h);
  bool can_flip(Index h) const;  ///< two triangles, strictly convex union, new edge not there yet
  /// Merges origin(h) into target(h). Precondition: `can_collapse(h)`.
  void collapse(Index h);
  bool can_collapse(Index h) const;  ///< topology only: the result is still a mesh
  /// Splits v: the edges from h (exclusive) counter-clockwise to k (exclusive) move to a new vertex at p, and a
  /// quad v, target(h), new, target(k) opens. h == k is not allowed. Returns the new vertex.
  Index open_quad(Index h, Index k, Vec2 p);
  /// Puts a layer of quads along the inside of a closed loop of half-edges (faces to shrink on their left): every
  /// node of the loop gets a copy for the inside, moved by `share` towards the centre of its faces there.
  /// Precondition: the loop passes each node once. Returns the copies, in the loop's order.
  std::vector<Index> pillow(const std::vector<Index>& loop, double share);
  /// Replaces everything inside the closed ring of half-edges (interior on their left) by one face.
  /// `faces` are the faces inside. Returns the face.
  Index make_face(std::span<const Index> ring, std::span<const Index> inside);

  /// New triangle outside of the boundary half-edge h, with a vertex v that has no element yet, at its point. Returns
  /// the face.
  Index attach_triangle(Index h, Index v);

  // --- transactions ------------------------------------------------------------------------------------
  /// Everything between begin() and rollback() is undone, to the bit. Not nested.
  void begin();
  void commit();
  void rollback();
  bool in_transaction() const { return recording_; }
  /// Values set in transactions so far, whether they were kept or not, and elements that somebody says he has looked
  /// at: a measure of work that is the same on every machine.
  std::size_t work() const { return work_; }
  void add_work(std::size_t elements) { work_ += elements; }
  /// Calls visit(index) for what the last transaction edited, some more than once, some dead by now. Until the next
  /// begin().
  template <class Visit>
  void for_edited_vertices(const Visit& visit) const {
    for (const auto& edit : vertex_pool_.old_values) visit(edit.first);
  }
  template <class Visit>
  void for_edited_faces(const Visit& visit) const {
    for (const auto& edit : face_pool_.old_values) visit(edit.first);
  }
  template <class Visit>
  void for_edited_half_edges(const Visit& visit) const {
    for (const auto& edit : edge_pool_.old_values) visit(edit.first);
  }
  /// Whether `commit()` looks at every element that the transaction touched and throws std::logic_error if one
  /// contradicts the invariants. Off at first.
  void check_commits(bool on) { checks_commits_ = on; }

 private:
  struct Pillow;
  template <std::size_t N>
  void build(const std::vector<Vec2>& points, const std::vector<std::array<Index, N>>& faces,
             const std::vector<bool>& open);
  bool is_star_above(Index v, double triangle_sine, double sine) const;
  void check_touched() const;
  HalfEdge& edit_half_edge(Index h) { return edit(edge_pool_, half_edges_, h); }
  Vertex& edit_vertex(Index v) { return edit(vertex_pool_, vertices_, v); }
  Face& edit_face(Index f) { return edit(face_pool_, faces_, f); }
  void link(Index h, Index after);
  void set_face(Index h, Index f) { edit_half_edge(h).face = f; }
  Index new_edge(Index from, Index to);
  Index new_face();
  Index new_vertex(Vec2 p);
  void kill_edge(Index h);
  void kill_face(Index f);
  void kill_vertex(Index v);
  void remove_two_gon(Index h);
  void set_out(Index v, Index h) { edit_vertex(v).out = h; }
  void refresh_out(Index v, Index h);

  std::vector<HalfEdge> half_edges_;
  std::vector<Vertex> vertices_;
  std::vector<Face> faces_;

  template <class T>
  struct Pool {
    std::vector<Index> free;      ///< dead slots, to be used again, last first
    std::vector<Index> taken;     ///< slots taken from `free` since begin()
    std::vector<Index> released;  ///< slots that died since begin(): free after commit()
    std::vector<std::pair<Index, T>> old_values;
    std::size_t size_at_begin = 0;
  };
  template <class T>
  void begin_pool(Pool<T>& pool, const std::vector<T>& values);
  template <class T>
  void commit_pool(Pool<T>& pool);
  template <class T>
  void rollback_pool(Pool<T>& pool, std::vector<T>& values);
  template <class T>
  T& edit(Pool<T>& pool, std::vector<T>& values, Index i) {
    if (recording_) pool.old_values.emplace_back(i, values[i]);
    return values[i];
  }
  template <class T>
  void release(Pool<T>& pool, Index i);

  Pool<HalfEdge> edge_pool_;  ///< slots are even half-edges
  Pool<Vertex> vertex_pool_;
  Pool<Face> face_pool_;
  /// Of make_face(), kept to avoid allocations.
  struct Scratch {
    std::vector<Index> sides, corners;
    std::vector<Index> inner;    ///< one half-edge of every edge that goes
    std::vector<Index> origins;  ///< of half-edges inside
  };
  Scratch scratch_;
  std::size_t work_ = 0;
  bool recording_ = false;
  bool checks_commits_ = false;
};

/// Everything that contradicts the invariants above, in words; empty for a legal mesh. With `geometry`, faces
/// that are not strictly convex are defects too. Cost: linear; not for inner loops.
std::vector<std::string> find_defects(const Mesh& mesh, bool geometry = true);

}  // namespace qmorph::kernel
