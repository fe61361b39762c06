// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernel/mesh.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "geometry/predicates.hpp"

namespace qmorph::kernel {
namespace {

/// Corners of a face that may have kNone for the last one.
template <std::size_t N>
Index corners_of(const std::array<Index, N>& face) {
  return face[N - 1] == kNone ? N - 1 : N;
}

}  // namespace

Mesh::Mesh(const std::vector<Vec2>& points, const std::vector<std::array<Index, 3>>& triangles,
           const std::vector<bool>& open) {
  build(points, triangles, open);
}

Mesh::Mesh(const std::vector<Vec2>& points, const std::vector<std::array<Index, 4>>& faces,
           const std::vector<bool>& open) {
  build(points, faces, open);
}

template <std::size_t N>
void Mesh::build(const std::vector<Vec2>& points, const std::vector<std::array<Index, N>>& faces,
                 const std::vector<bool>& open) {
  const auto is_open = [&](std::size_t side) { return side < open.size() && open[side]; };
  // Some room, so that edits do not move all at once.
  const auto with_room = [](std::size_t size) { return size + size / 8 + 64; };
  vertices_.reserve(with_room(points.size()));
  for (const Vec2& p : points) vertices_.push_back({.point = p});
  faces_.reserve(with_room(faces.size()));
  half_edges_.reserve(with_room(faces.size() * N));

  // Edges that wait for their other half, in a chain that starts at whichever of their vertices has fewer corners, so
  // that chains are short even where fans meet.
  std::vector<Index> corners(vertices_.size(), 0);
  for (const auto& face : faces)
    for (Index i = 0; i < corners_of(face); ++i) ++corners[face[i]];
  std::vector<Index> first(vertices_.size(), kNone), following;  // following: by edge
  following.reserve(half_edges_.capacity() / 2);
  for (Index f = 0; f < faces.size(); ++f) {
    const Index degree = corners_of(faces[f]);
    std::array<Index, N> h{};
    for (Index i = 0; i < degree; ++i) {
      const Index a = faces[f][i], b = faces[f][(i + 1) % degree];
      const bool stays_open = is_open(N * f + i);
      const bool is_a = corners[a] != corners[b] ? corners[a] < corners[b] : a < b;
      Index* waiting = &first[is_a ? a : b];
      while (!stays_open && *waiting != kNone && !(origin(*waiting) == b && target(*waiting) == a))
        waiting = &following[*waiting / 2];
      if (!stays_open && *waiting != kNone) {
        h[i] = twin(*waiting);
        *waiting = following[*waiting / 2];
      } else {
        h[i] = half_edge_slots();
        half_edges_.push_back({a, kNone, kNone, kNone});
        half_edges_.push_back({b, kNone, kNone, kNone});
        if (!stays_open) *waiting = h[i];
        following.push_back(kNone);
      }
      vertices_[a].out = h[i];
    }
    for (Index i = 0; i < degree; ++i) {
      half_edges_[h[i]].face = f;
      half_edges_[h[i]].next = h[(i + 1) % degree];
      half_edges_[h[i]].prev = h[(i + degree - 1) % degree];
    }
    faces_.push_back({h[0], degree});
  }
  std::vector<Index> outside;
  for (Index h = 0; h < half_edges_.size(); ++h)
    if (face(h) == kNone) outside.push_back(h), vertices_[origin(h)].out = h;
  for (Index h : outside) {
    const Index following_h = out(target(h));
    half_edges_[h].next = following_h;
    half_edges_[following_h].prev = h;
  }
}

Index Mesh::valence(AnyNode v) const {
  Index count = 0;
  HalfEdgeId h = out(v);
  do {
    ++count;
    h = rotate_ccw(h);
  } while (h != out(v) && count < kManyEdges);
  return count;
}

std::vector<Index> Mesh::valences() const {
  std::vector<Index> valences(vertex_slots(), 0);
  for (Index h = 0; h < half_edge_slots(); ++h)
    if (is_live_half_edge(h)) ++valences[origin(h)];
  return valences;
}

HalfEdgeId Mesh::find(AnyNode a, AnyNode b) const {
  for (HalfEdgeId h : around(a))
    if (target(h) == b) return h;
  return {};
}

// --- edits ----------------------------------------------------------------------------------------------

void Mesh::set_fixed(AnyNode v) { edit_vertex(v).fixed = true; }

void Mesh::link(AnyHalfEdge h, AnyHalfEdge after) {
  edit_half_edge(h).next = after;
  edit_half_edge(after).prev = h;
}

/// Keeps the rule that a boundary vertex's half-edge is the boundary one.
void Mesh::refresh_out(AnyNode v, AnyHalfEdge h) {
  for (HalfEdgeId e : around_from(h))
    if (face(e) == kNone) {
      h = e;
      break;
    }
  if (out(v) != h) set_out(v, h);
}

NodeId Mesh::split_edge(AnyHalfEdge h, Vec2 p) {
  const NodeId b = target(h), m = new_vertex(p);
  const HalfEdgeId t = twin(h), n = new_edge(m, b), after = next(h), before = prev(t);
  const FaceId f = face(h), g = face(t);
  edit_half_edge(t).origin = m;
  link(h, n);
  link(n, after);
  link(before, twin(n));
  link(twin(n), t);
  set_face(n, f);
  set_face(twin(n), g);
  if (f != kNone) ++edit_face(f).degree;
  if (g != kNone) ++edit_face(g).degree;
  if (out(b) == t) set_out(b, twin(n));
  set_out(m, g == kNone ? t : n);
  return m;
}

HalfEdgeId Mesh::split_face(AnyHalfEdge g, AnyHalfEdge h) {
  assert(face(g) == face(h) && g != h);
  const HalfEdgeId before_g = prev(g), before_h = prev(h), d = new_edge(origin(g), origin(h));
  const FaceId f = face(g), other = new_face();
  link(before_g, d);
  link(d, h);
  link(before_h, twin(d));
  link(twin(d), g);
  set_face(d, f);
  Index other_degree = 1;
  set_face(twin(d), other);
  for (Index e = g; e != twin(d); e = next(e), ++other_degree) set_face(e, other);
  edit_face(other) = {twin(d), other_degree};
  Face& kept = edit_face(f);
  kept = {d, kept.degree + 2 - other_degree};
  return d;
}

FaceId Mesh::attach_triangle(AnyHalfEdge h, AnyNode v) {
  assert(face(h) == kNone && !is_live_vertex(v));
  const NodeId a = origin(h), b = target(h);
  const HalfEdgeId before = prev(h), after = next(h), bv = new_edge(b, v), va = new_edge(v, a);
  const FaceId f = new_face();
  link(before, twin(va)), link(twin(va), twin(bv)), link(twin(bv), after);
  link(h, bv), link(bv, va), link(va, h);
  set_face({h, bv, va}, f);
  edit_face(f) = {h, 3};
  set_out(a, twin(va)), set_out(v, twin(bv));
  return f;
}

HalfEdgeId Mesh::join_faces(AnyHalfEdge h) {
  const HalfEdgeId t = twin(h), joined = next(h);
  const FaceId f = face(h), g = face(t);
  assert(f != kNone && g != kNone && f != g);
  const NodeId a = origin(h), b = target(h);
  for (Index e = next(t); e != t; e = next(e)) set_face(e, f);
  edit_face(f) = {joined, degree(f) + degree(g) - 2};
  kill_face(g);
  const HalfEdgeId from_a = next(t);
  link(prev(h), next(t));
  link(prev(t), joined);
  kill_edge(h);
  if (out(a) == h) set_out(a, from_a);
  if (out(b) == t) set_out(b, joined);
  return joined;
}

bool Mesh::can_flip(AnyHalfEdge h) const {
  const HalfEdgeId t = twin(h);
  if (!is_triangle(face(h)) || !is_triangle(face(t))) return false;
  const NodeId a = origin(h), b = target(h), c = origin(prev(h)), d = origin(prev(t));
  const auto is_triangle_valid = [&](NodeId u, NodeId v, NodeId w) {
    return is_convex_corner(point(u), point(v), point(w), kDegenerateSine) &&
           is_convex_corner(point(v), point(w), point(u), kDegenerateSine) &&
           is_convex_corner(point(w), point(u), point(v), kDegenerateSine);
  };
  return is_triangle_valid(a, d, c) && is_triangle_valid(d, b, c) && find(c, d) == kNone;
}

void Mesh::flip(AnyHalfEdge h) {
  //      c            c        h: a -> b becomes h: d -> c
  //    / | \        / | \      .
  //   a--h--b  ->  a  h  b     (drawn with a left, b right, the old edge horizontal)
  //    \ | /        \ | /
  //      d            d
  const HalfEdgeId t = twin(h);
  const FaceId f = face(h), g = face(t);
  const HalfEdgeId bc = next(h), ca = prev(h), ad = next(t), db = prev(t);
  const NodeId a = origin(h), b = origin(t), c = origin(ca), d = origin(db);
  edit_half_edge(h).origin = d;
  edit_half_edge(t).origin = c;
  link(h, ca), link(ca, ad), link(ad, h);
  link(t, db), link(db, bc), link(bc, t);
  set_face(ad, f);
  set_face(bc, g);
  edit_face(f).half_edge = h;
  edit_face(g).half_edge = t;
  if (out(a) == h) set_out(a, ad);
  if (out(b) == t) set_out(b, bc);
}

bool Mesh::can_collapse(AnyHalfEdge h) const {
  const NodeId a = origin(h), b = target(h);
  if (is_boundary(a) || is_fixed(a)) return false;
  const FaceId f = face(h), g = face(twin(h));
  const NodeId left = is_triangle(f) ? origin(prev(h)) : NodeId();
  const NodeId right = is_triangle(g) ? origin(prev(twin(h))) : NodeId();
  if (left != kNone && (left == right || valence(left) < 3)) return false;
  if (right != kNone && valence(right) < 3) return false;
  for (HalfEdgeId e : around_from(h)) {
    const NodeId x = target(e);
    if (x != b && x != left && x != right && find(x, b) != kNone) return false;
    // A quad that has a and b at opposite corners would meet b twice.
    if (face(e) != f && face(e) != g && is_quad(face(e)) && target(next(e)) == b) return false;
  }
  return true;
}

void Mesh::collapse(AnyHalfEdge h) {
  assert(can_collapse(h));
  const HalfEdgeId t = twin(h), after_h = next(h), after_t = next(t);
  const NodeId a = origin(h), b = target(h);
  const FaceId f = face(h), g = face(t);
  for (HalfEdgeId e = rotate_ccw(h); e != h; e = rotate_ccw(e)) edit_half_edge(e).origin = b;
  link(prev(h), after_h);
  link(prev(t), after_t);
  const auto lose_side = [&](FaceId face, HalfEdgeId after) {
    if (face == kNone) return;
    edit_face(face).half_edge = after;
    --edit_face(face).degree;
  };
  lose_side(f, after_h);
  lose_side(g, after_t);
  if (out(b) == t) set_out(b, after_h);
  kill_edge(h);
  kill_vertex(a);
  if (f != kNone && degree(f) == 2) remove_two_gon(after_h);
  if (g != kNone && degree(g) == 2) remove_two_gon(after_t);
}

/// A face with two sides vanishes; the edge of h stays in the place of both.
void Mesh::remove_two_gon(AnyHalfEdge h) {
  const HalfEdgeId k = next(h), outer = twin(k), before = prev(outer), after = next(outer);
  const NodeId u = origin(h), v = origin(k);
  const FaceId gone = face(h), beyond = face(outer);
  link(before, h);
  link(h, after);
  set_face(h, beyond);
  if (beyond != kNone) edit_face(beyond).half_edge = h;
  if (out(u) == outer) set_out(u, h);
  if (out(v) == k) set_out(v, twin(h));
  kill_face(gone);
  kill_edge(k);
}

NodeId Mesh::open_quad(AnyHalfEdge h, AnyHalfEdge k, Vec2 p) {
  //        x                 x
  //        |               /   \        The edges between h = (v, x) and k = (v, y), counter-clockwise,
  //   -----v-----  ->  ---w  Q  v---    go over to w.
  //        |               \   /
  //        y                 y
  const NodeId v = origin(h), x = target(h), y = target(k);
  const HalfEdgeId back = twin(k);
  assert(h != k && rotate_ccw(h) != k);
  const NodeId w = new_vertex(p);
  for (HalfEdgeId e = rotate_ccw(h); e != k;) {
    const HalfEdgeId following = rotate_ccw(e);
    edit_half_edge(e).origin = w;
    e = following;
  }
  const HalfEdgeId wx = new_edge(w, x), wy = new_edge(w, y);
  const FaceId quad = new_face(), left = face(h), right = face(back);
  const HalfEdgeId before_h = prev(h), after_h = next(h), before_back = prev(back), after_back = next(back);
  link(before_h, wx), link(wx, after_h);
  link(before_back, twin(wy)), link(twin(wy), after_back);
  set_face(wx, left), set_face(twin(wy), right);
  edit_face(left).half_edge = wx;
  edit_face(right).half_edge = twin(wy);
  link(h, twin(wx)), link(twin(wx), wy), link(wy, back), link(back, h);
  set_face({h, twin(wx), wy, back}, quad);
  edit_face(quad) = {h, 4};
  set_out(w, wx);
  refresh_out(v, h);
  return w;
}

FaceId Mesh::make_face(std::span<const Index> ring, std::span<const Index> inside) {
  constexpr Index kOnRing = kNone - 1;  // for the face of the ring's half-edges, until all is gathered
  auto& [faces, inner, origins] = scratch_;
  faces.clear(), inner.clear(), origins.clear();
  for (Index r : ring) {
    const Index v = origin(r);
    if (face(out(v)) != kNone) set_out(v, r);
  }
  for (Index r : ring) faces.push_back(std::exchange(half_edges_[r].face, kOnRing));
  for (Index f : inside) {
    for (HalfEdgeId h : sides_of(f)) {
      if (face(h) == kOnRing) continue;
      origins.push_back(origin(h));
      if ((h & 1) == 0) inner.push_back(h);
    }
  }
  // From a node on the ring leads one of its half-edges, or the boundary's.
  std::erase_if(origins, [&](Index v) { return face(out(v)) == kOnRing || face(out(v)) == kNone; });
  for (std::size_t i = ring.size(); i-- > 0;) half_edges_[ring[i]].face = faces[i];
  for (Index v : origins)
    if (is_live_vertex(v)) kill_vertex(v);
  for (Index h : inner) kill_edge(h);
  for (Index f : inside) kill_face(f);
  const FaceId face = new_face();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    set_face(ring[i], face);
    link(ring[i], ring[(i + 1) % ring.size()]);
  }
  edit_face(face) = {ring[0], Index(ring.size())};
  return face;
}

}  // namespace qmorph::kernel
