// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>

#include "front/step.hpp"

namespace qmorph::front {

Index form_face(Step& step, std::span<const Index> ring, std::size_t most_triangles) {
  kernel::Mesh& mesh = step.mesh;
  const auto on_ring = [&](Index h) { return std::find(ring.begin(), ring.end(), h) != ring.end(); };
  const auto is_ring_node = [&](Index v) {
    return std::any_of(ring.begin(), ring.end(), [&](Index r) { return mesh.origin(r) == v; });
  };
  std::vector<Index>& inside = step.scratch;
  inside.assign(1, mesh.face(ring[0]));
  step.marked.clear();
  step.marked.insert(inside[0]);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    for (Index h : mesh.sides_of(inside[i])) {
      const Index beyond = mesh.face(Mesh::twin(h));
      if (!on_ring(h)) {
        if (!mesh.is_triangle(beyond)) return kNone;  // a hole, a quad, a constraint
        if (step.marked.insert(beyond)) {
          if (inside.size() >= most_triangles) return kNone;
          inside.push_back(beyond);
        }
        const Index v = mesh.origin(h);
        if (mesh.is_fixed(v) && !is_ring_node(v)) return kNone;
      }
    }
  }
  for (Index r : ring)  // the ring must really enclose what was found
    if (!mesh.is_triangle(mesh.face(r)) || !step.marked.contains(mesh.face(r))) return kNone;
  if (ring.size() == 4 && inside.size() == 2) {  // nearly always: one edge goes
    Index diagonal = mesh.next(ring[0]);
    if (on_ring(diagonal)) diagonal = mesh.next(diagonal);
    return mesh.face(mesh.join_faces(diagonal));
  }
  return mesh.make_face(ring, inside);
}

}  // namespace qmorph::front
