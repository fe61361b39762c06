#include "topology/edits.hpp"

#include <algorithm>

namespace qmorph::topology {

Index remove_doublet(kernel::Mesh& mesh, Index v) {
  const Index h = mesh.out(v), k = mesh.rotate_ccw(h);
  const Index f = mesh.face(h), g = mesh.face(k);
  // Of each face's ring, all but the two half-edges at v.
  std::vector<Index> ring;
  for (Index start : {h, k})
    for (Index e = mesh.next(start); mesh.target(e) != v; e = mesh.next(e)) ring.push_back(e);
  return mesh.make_face(ring, {f, g});
}

std::size_t remove_doublets(kernel::Mesh& mesh, std::vector<Index> nodes) {
  std::size_t removed = 0;
  while (!nodes.empty()) {
    const Index v = nodes.back();
    nodes.pop_back();
    if (!mesh.is_live_vertex(v) || mesh.is_boundary(v) || mesh.is_fixed(v) || mesh.valence(v) != 2)
      continue;
    const Index h = mesh.out(v);
    const Index f = mesh.face(h), g = mesh.face(mesh.rotate_ccw(h));
    if (f == g || mesh.degree(f) + mesh.degree(g) < 7) continue;
    const Index face = remove_doublet(mesh, v);
    ++removed;
    const Index start = mesh.half_edge(face);
    Index e = start;
    do {
      nodes.push_back(mesh.origin(e));
      e = mesh.next(e);
    } while (e != start);
  }
  return removed;
}

double smallest_sine(const kernel::Mesh& mesh, const std::vector<Index>& nodes) {
  const std::size_t n = nodes.size();
  double least = 1;
  for (std::size_t i = 0; i < n; ++i)
    least = std::min(least, corner_sine(mesh.point(nodes[i]), mesh.point(nodes[(i + 1) % n]),
                                        mesh.point(nodes[(i + n - 1) % n])));
  return least;
}

}  // namespace qmorph::topology
