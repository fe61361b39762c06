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

#include <array>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "geometry/vec2.hpp"
#include "kernel/ids.hpp"
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
template <HalfEdgeId (Mesh::*following)(AnyHalfEdge) const>
class Circle {
 public:
  class Iterator {
   public:
    Iterator(const Mesh& mesh, HalfEdgeId first) : mesh_(mesh), first_(first), at_(first) {}
    HalfEdgeId operator*() const { return at_; }
    Iterator& operator++() {
      at_ = (mesh_.*following)(at_);
      is_begin_ = false;
      return *this;
    }
    bool operator==(std::default_sentinel_t) const { return at_ == first_ && !is_begin_; }

   private:
    const Mesh& mesh_;
    HalfEdgeId first_, at_;
    bool is_begin_ = true;
  };
  Circle(const Mesh& mesh, HalfEdgeId first) : mesh_(mesh), first_(first) {}
  Iterator begin() const { return {mesh_, first_}; }
  std::default_sentinel_t end() const { return {}; }

 private:
  const Mesh& mesh_;
  HalfEdgeId first_;
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
  static HalfEdgeId twin(AnyHalfEdge h) { return HalfEdgeId(h ^ 1); }
  static std::array<HalfEdgeId, 2> halves_of(AnyHalfEdge h) { return {HalfEdgeId(h), twin(h)}; }
  HalfEdgeId next(AnyHalfEdge h) const { return HalfEdgeId(half_edges_[h].next); }
  HalfEdgeId prev(AnyHalfEdge h) const { return HalfEdgeId(half_edges_[h].prev); }
  FaceId face(AnyHalfEdge h) const { return FaceId(half_edges_[h].face); }
  NodeId origin(AnyHalfEdge h) const { return NodeId(half_edges_[h].origin); }
  NodeId target(AnyHalfEdge h) const { return NodeId(half_edges_[h ^ 1].origin); }
  HalfEdgeId out(AnyNode v) const { return HalfEdgeId(vertices_[v].out); }
  HalfEdgeId half_edge(AnyFace f) const { return HalfEdgeId(faces_[f].half_edge); }
  Index degree(AnyFace f) const { return faces_[f].degree; }
  const Vec2& point(AnyNode v) const { return vertices_[v].point; }
  bool is_fixed(AnyNode v) const { return vertices_[v].fixed; }
  /// May move, and vanish.
  bool is_free(AnyNode v) const { return !is_fixed(v) && !is_boundary(v); }
  bool is_triangle(AnyFace f) const { return f != kNone && faces_[f].degree == 3; }
  bool is_quad(AnyFace f) const { return f != kNone && faces_[f].degree == 4; }
  bool is_boundary_edge(AnyHalfEdge h) const { return face(h) == kNone || face(h ^ 1) == kNone; }
  bool is_boundary(AnyNode v) const { return face(out(v)) == kNone; }
  /// The outgoing half-edge that follows h counter-clockwise around its origin.
  HalfEdgeId rotate_ccw(AnyHalfEdge h) const { return twin(prev(h)); }
  HalfEdgeId rotate_cw(AnyHalfEdge h) const { return next(twin(h)); }
  /// The half-edges that leave v, counter-clockwise; from the boundary's one, if there is one.
  Circle<&Mesh::rotate_ccw> around(AnyNode v) const { return {*this, out(v)}; }
  /// The same from one boundary edge to the other, the inside between them, if v is on the boundary.
  Circle<&Mesh::rotate_ccw> around_inside(AnyNode v) const {
    return {*this, is_boundary(v) ? rotate_ccw(out(v)) : out(v)};
  }
  /// The half-edges that leave origin(h), counter-clockwise from h on.
  Circle<&Mesh::rotate_ccw> around_from(AnyHalfEdge h) const { return {*this, HalfEdgeId(h)}; }
  /// The half-edges of a face, counter-clockwise.
  Circle<&Mesh::next> sides_of(AnyFace f) const { return {*this, half_edge(f)}; }
  /// The half-edges of a face, or of a boundary, from h on.
  Circle<&Mesh::next> loop_from(AnyHalfEdge h) const { return {*this, HalfEdgeId(h)}; }
  Vec2 vector(AnyHalfEdge h) const { return point(target(h)) - point(origin(h)); }
  double length(AnyHalfEdge h) const { return vector(h).norm(); }
  /// Calls visit(v) for the corners of a face, in their order.
  template <class Visit>
  void for_nodes_of(AnyFace f, const Visit& visit) const {
    for (Index h : sides_of(f)) visit(origin(h));
  }
  /// Edges at v, or `kManyEdges` for so many and more: callers only tell small numbers apart, and walking around a
  /// large fan each time would be quadratic.
  Index valence(AnyNode v) const;
  static constexpr Index kManyEdges = 64;
  /// Of all vertices, by vertex; 0 for dead ones.
  std::vector<Index> valences() const;
  /// The half-edge from a to b, or kNone. O(valence).
  HalfEdgeId find(AnyNode a, AnyNode b) const;

  /// For walks that will come to v: the processor fetches it, or an edge there, meanwhile.
  void prefetch_node(AnyNode v) const { __builtin_prefetch(&vertices_[v]); }
  void prefetch_edge_at(AnyNode v) const { __builtin_prefetch(half_edges_.data() + vertices_[v].out); }

  bool is_live_vertex(AnyNode v) const { return vertices_[v].out != kNone; }
  bool is_live_face(AnyFace f) const { return faces_[f].half_edge != kNone; }
  bool is_live_half_edge(AnyHalfEdge h) const { return half_edges_[h].origin != kNone; }
  /// Sizes of the index ranges, dead elements included.
  Index vertex_slots() const { return Index(vertices_.size()); }
  Index half_edge_slots() const { return Index(half_edges_.size()); }
  Index face_slots() const { return Index(faces_.size()); }

  // --- geometry of elements -----------------------------------------------------------------------------
  /// All corners of the face are convex, by more than `kStraightSine` (`kDegenerateSine` in a triangle).
  bool is_valid_face(AnyFace f) const;
  /// Every face around v is valid.
  bool is_valid_star(AnyNode v) const;
  /// All corners of the face (of the faces around v) are convex and have a larger sine than this. Cheaper than the sine
  /// itself.
  bool is_above(AnyFace f, double sine) const;
  bool is_star_above(AnyNode v, double sine) const;
  /// Smallest sine of the face's corners, signed: its scaled Jacobian.
  double smallest_sine(AnyFace f) const;
  /// The smallest of those of the faces around v.
  double smallest_sine_around(AnyNode v) const;
  /// Mean length of the edges at v.
  double mean_edge(AnyNode v) const;
  /// The same of all vertices, by vertex; 0 for dead ones. Each edge is measured once.
  std::vector<double> mean_edges() const;

  // --- edits ----------------------------------------------------------------------------------------
  void set_point(AnyNode v, const Vec2& p) { edit_vertex(v).point = p; }
  void set_fixed(AnyNode v);
  // A new vertex' point is taken by value: it may move the array that a reference points into.
  /// New vertex at p on the edge of h: h ends there. Both faces gain a side. Returns the vertex.
  NodeId split_edge(AnyHalfEdge h, Vec2 p);
  /// New edge from origin(g) to origin(h), two half-edges of one face; it lies left of the face's part
  /// that starts with h. Returns the half-edge origin(g) -> origin(h).
  HalfEdgeId split_face(AnyHalfEdge g, AnyHalfEdge h);
  /// Removes the edge of h; its two faces become one, face(h). Returns a half-edge of it.
  HalfEdgeId join_faces(AnyHalfEdge h);
  /// Turns the diagonal of two triangles. Precondition: `can_flip(h)`.
  void flip(AnyHalfEdge h);
  bool can_flip(AnyHalfEdge h) const;  ///< two triangles, strictly convex union, new edge not there yet
  /// Merges origin(h) into target(h). Precondition: `can_collapse(h)`.
  void collapse(AnyHalfEdge h);
  bool can_collapse(AnyHalfEdge h) const;  ///< topology only: the result is still a mesh
  /// Splits v: the edges from h (exclusive) counter-clockwise to k (exclusive) move to a new vertex at p, and a
  /// quad v, target(h), new, target(k) opens. h == k is not allowed. Returns the new vertex.
  NodeId open_quad(AnyHalfEdge h, AnyHalfEdge k, Vec2 p);
  /// Puts a layer of quads along the inside of a closed loop of half-edges (faces to shrink on their left): every
  /// node of the loop gets a copy for the inside, moved by `share` towards the centre of its faces there.
  /// Precondition: the loop passes each node once. Returns the copies, in the loop's order.
  std::vector<Index> pillow(const std::vector<Index>& loop, double share);
  /// Replaces everything inside the closed ring of half-edges (interior on their left) by one face.
  /// `inside` lists the faces there. Returns the face.
  FaceId make_face(std::span<const Index> ring, std::span<const Index> inside);

  /// New triangle outside of the boundary half-edge h, with a vertex v that has no element yet, at its point. Returns
  /// the face.
  FaceId attach_triangle(AnyHalfEdge h, AnyNode v);

  // --- transactions ------------------------------------------------------------------------------------
  /// Everything between begin() and rollback() is undone, to the bit. Not nested.
  void begin();
  void commit();
  void rollback();
  bool in_transaction() const { return recording_; }
  /// Values set in transactions so far, whether they were kept or not, plus elements that callers report to have looked
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
  bool is_star_above(AnyNode v, double triangle_sine, double sine) const;
  void check_touched() const;
  HalfEdge& edit_half_edge(AnyHalfEdge h) { return edit(edge_pool_, half_edges_, h); }
  Vertex& edit_vertex(AnyNode v) { return edit(vertex_pool_, vertices_, v); }
  Face& edit_face(AnyFace f) { return edit(face_pool_, faces_, f); }
  void link(AnyHalfEdge h, AnyHalfEdge after);
  void set_face(AnyHalfEdge h, AnyFace f) { edit_half_edge(h).face = f; }
  void set_face(std::initializer_list<Index> sides, AnyFace f) {
    for (Index h : sides) set_face(h, f);
  }
  HalfEdgeId new_edge(AnyNode from, AnyNode to);
  FaceId new_face();
  NodeId new_vertex(Vec2 p);
  void kill_edge(AnyHalfEdge h);
  void kill_face(AnyFace f);
  void kill_vertex(AnyNode v);
  void remove_two_gon(AnyHalfEdge h);
  void set_out(AnyNode v, AnyHalfEdge h) { edit_vertex(v).out = h; }
  void refresh_out(AnyNode v, AnyHalfEdge h);

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
    std::vector<Index> faces;    ///< of the ring's half-edges
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
