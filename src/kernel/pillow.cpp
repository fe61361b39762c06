// SPDX-License-Identifier: GPL-2.0-or-later
/// Mesh::pillow().
#include "kernel/mesh.hpp"

namespace qmorph::kernel {

//   v0--b0--v1     b: half-edges of the loop, which go over to the new quads
//   |s0     |s1    s: spokes, from a node v of the loop to its copy w
//   w0--n0--w1     n: what takes the place of b in the faces inside
struct Mesh::Pillow {
  Mesh& mesh;
  const std::vector<Index>& loop;
  std::vector<Index> copies, inner, spokes;      ///< w, n and s, in the loop's order
  std::vector<std::vector<Index>> leaving = {};  ///< by node of the loop: half-edges to the inside, which its copy gets

  std::size_t before(std::size_t i) const { return (i + loop.size() - 1) % loop.size(); }
  std::size_t after(std::size_t i) const { return (i + 1) % loop.size(); }

  /// A node's copy, `share` of the way to the mean of the neighbours that it has inside and on the loop.
  void copy_node(std::size_t i, double share) {
    const HalfEdgeId along(loop[i]), back = twin(loop[before(i)]);
    Vec2 sum = mesh.point(mesh.target(along));
    int neighbours = 1;
    for (HalfEdgeId e = along; e != back;) {
      e = mesh.rotate_ccw(e);
      if (e != back) leaving[i].push_back(e);
      sum += mesh.point(mesh.target(e)), ++neighbours;
    }
    const Vec2& p = mesh.point(mesh.origin(along));
    copies[i] = mesh.new_vertex(p + share * (sum / neighbours - p));
  }

  void make_edges(std::size_t i) {
    inner[i] = mesh.new_edge(copies[i], copies[after(i)]);
    spokes[i] = mesh.new_edge(mesh.origin(loop[i]), copies[i]);
  }

  /// Puts n in the place of b in the face inside.
  void replace_side(std::size_t i) {
    const HalfEdgeId b(loop[i]), old_prev = mesh.prev(b), old_next = mesh.next(b);
    const FaceId f = mesh.face(b);
    // A neighbour in the loop has been, or will be, replaced as well.
    mesh.link(old_prev == loop[before(i)] ? inner[before(i)] : old_prev, inner[i]);
    if (old_next != loop[after(i)]) mesh.link(inner[i], old_next);
    mesh.set_face(inner[i], f);
    mesh.edit_face(f).half_edge = inner[i];
    for (Index e : leaving[i]) mesh.edit_half_edge(e).origin = copies[i];
  }

  void make_quad(std::size_t i) {
    const FaceId quad = mesh.new_face();
    const std::array<Index, 4> sides{loop[i], spokes[after(i)], twin(inner[i]), twin(spokes[i])};
    for (std::size_t k = 0; k < 4; ++k) mesh.link(sides[k], sides[(k + 1) % 4]);
    for (Index e : sides) mesh.set_face(e, quad);
    mesh.edit_face(quad) = {loop[i], 4};
    mesh.set_out(copies[i], inner[i]);
    const NodeId v = mesh.origin(loop[i]);
    if (mesh.origin(mesh.out(v)) != v) mesh.set_out(v, loop[i]);  // what left v there is its copy's now
  }
};

std::vector<Index> Mesh::pillow(const std::vector<Index>& loop, double share) {
  const std::size_t size = loop.size();
  Pillow p{*this, loop, std::vector<Index>(size), std::vector<Index>(size), std::vector<Index>(size)};
  p.leaving.resize(size);
  for (std::size_t i = 0; i < size; ++i) p.copy_node(i, share);
  for (std::size_t i = 0; i < size; ++i) p.make_edges(i);
  for (std::size_t i = 0; i < size; ++i) p.replace_side(i);
  for (std::size_t i = 0; i < size; ++i) p.make_quad(i);
  return std::move(p.copies);
}

}  // namespace qmorph::kernel
