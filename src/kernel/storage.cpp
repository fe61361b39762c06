// SPDX-License-Identifier: GPL-2.0-or-later
/// Slots and transactions of the half-edge mesh. Slots of dead elements are used again, last first; a
/// transaction keeps the old value of everything it touches, so that a rollback restores every bit,
/// the free lists included.
#include <cassert>

#include "kernel/mesh.hpp"

namespace qmorph::kernel {

template <class T>
void Mesh::release(Pool<T>& pool, Index i) {
  (recording_ ? pool.released : pool.free).push_back(i);
}

namespace {

/// A dead slot, or kNone when there is none.
template <class Pool>
Index take(Pool& pool, bool recording) {
  if (pool.free.empty()) return kNone;
  const Index i = pool.free.back();
  pool.free.pop_back();
  if (recording) pool.taken.push_back(i);
  return i;
}

}  // namespace

HalfEdgeId Mesh::new_edge(AnyNode from, AnyNode to) {
  Index h = take(edge_pool_, recording_);
  if (h == kNone) {
    h = Index(half_edges_.size());
    half_edges_.resize(half_edges_.size() + 2);
  }
  edit_half_edge(h) = {.origin = from};
  edit_half_edge(h ^ 1) = {.origin = to};
  return HalfEdgeId(h);
}

NodeId Mesh::new_vertex(Vec2 p) {
  Index v = take(vertex_pool_, recording_);
  if (v == kNone) {
    v = Index(vertices_.size());
    vertices_.emplace_back();
  }
  edit_vertex(v) = {.point = p};
  return NodeId(v);
}

FaceId Mesh::new_face() {
  Index f = take(face_pool_, recording_);
  if (f == kNone) {
    f = Index(faces_.size());
    faces_.emplace_back();
  }
  edit_face(f) = {};
  return FaceId(f);
}

void Mesh::kill_edge(AnyHalfEdge h) {
  const Index slot = h & ~Index(1);
  edit_half_edge(slot) = {};
  edit_half_edge(slot + 1) = {};
  release(edge_pool_, slot);
}

void Mesh::kill_vertex(AnyNode v) {
  edit_vertex(v).out = kNone;
  release(vertex_pool_, v);
}

void Mesh::kill_face(AnyFace f) {
  edit_face(f) = {};
  release(face_pool_, f);
}

// --- transactions ---------------------------------------------------------------------------------------

template <class T>
void Mesh::begin_pool(Pool<T>& pool, const std::vector<T>& values) {
  pool.taken.clear();
  pool.released.clear();
  pool.old_values.clear();
  pool.size_at_begin = values.size();
}

template <class T>
void Mesh::commit_pool(Pool<T>& pool) {
  work_ += pool.old_values.size();
  pool.free.insert(pool.free.end(), pool.released.begin(), pool.released.end());
}

template <class T>
void Mesh::rollback_pool(Pool<T>& pool, std::vector<T>& values) {
  work_ += pool.old_values.size();
  for (auto it = pool.old_values.rbegin(); it != pool.old_values.rend(); ++it) values[it->first] = it->second;
  values.resize(pool.size_at_begin);
  pool.free.insert(pool.free.end(), pool.taken.rbegin(), pool.taken.rend());
}

void Mesh::begin() {
  assert(!recording_);
  recording_ = true;
  begin_pool(edge_pool_, half_edges_);
  begin_pool(vertex_pool_, vertices_);
  begin_pool(face_pool_, faces_);
}

void Mesh::commit() {
  assert(recording_);
  if (checks_commits_) check_touched();
  recording_ = false;
  commit_pool(edge_pool_);
  commit_pool(vertex_pool_);
  commit_pool(face_pool_);
}

void Mesh::rollback() {
  assert(recording_);
  recording_ = false;
  rollback_pool(edge_pool_, half_edges_);
  rollback_pool(vertex_pool_, vertices_);
  rollback_pool(face_pool_, faces_);
}

}  // namespace qmorph::kernel
