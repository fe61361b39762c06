// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <array>

#include "front/step.hpp"

namespace qmorph::front {
namespace {

/// With more triangles than this between two front edges there is no gap to be sewn.
constexpr std::size_t kMostTrianglesInGap = 24;
/// With fewer quads around it the node between the edges would be irregular: 2 a doublet, 1 a vanished quad.
constexpr int kFewestQuads = 3;

int quads_around(const Mesh& mesh, Index v) {
  int quads = 0;
  for (Index h : mesh.around(v)) quads += mesh.is_quad(mesh.face(h));
  return quads;
}

/// Gives every front edge at v the level of the front that it continues.
void inherit_level(Step& step, Index v, unsigned level) {
  const Mesh& mesh = step.mesh;
  for (Index h : mesh.around(v)) {
    for (Index e : Mesh::halves_of(h))
      if (step.front.contains(e)) step.front.set_level(e, level);
  }
}

Index some_quad_around(const Mesh& mesh, Index v) {
  for (Index h : mesh.around(v))
    if (mesh.is_quad(mesh.face(h))) return mesh.face(h);
  return kNone;
}

}  // namespace

bool seam(Step& step, Index incoming, Index outgoing) {
  kernel::Mesh& mesh = step.mesh;
  const Index p = mesh.origin(incoming), k = mesh.target(incoming), n = mesh.target(outgoing);
  const bool free_p = mesh.is_free(p), free_n = mesh.is_free(n);
  if (p == n || (!free_p && !free_n) || mesh.is_boundary(k)) return false;
  if (quads_around(mesh, k) < kFewestQuads) return false;
  const unsigned level = std::max(step.front.level(incoming), step.front.level(outgoing));

  const Index chord = recover_edge(step, incoming, n);  // p -> n, the gap on its right
  if (chord == kNone) return false;
  if (form_face(step, std::array<Index, 3>{outgoing, Mesh::twin(chord), incoming}, kMostTrianglesInGap) == kNone)
    return false;
  const Index gone = free_p ? chord : Mesh::twin(chord);  // starts at the node that vanishes
  const Index kept = mesh.target(gone);
  if (!mesh.can_collapse(gone)) return false;
  const Vec2 middle = 0.5 * (mesh.point(p) + mesh.point(n));
  mesh.collapse(gone);
  if (free_p && free_n) mesh.set_point(kept, middle);
  inherit_level(step, kept, level);
  step.moved.insert(step.moved.end(), {kept, k});
  if (const Index quad = some_quad_around(mesh, kept); quad != kNone) smooth_around(step, quad);
  return mesh.is_valid_star(kept) && mesh.is_valid_star(k);
}

}  // namespace qmorph::front
