#include "cleanup/transaction.hpp"

#include <algorithm>


namespace qmorph::cleanup {

double worst_around(const kernel::Mesh& mesh, const std::vector<Index>& nodes) {
  double worst = 1;
  for (Index v : nodes)
    if (mesh.is_live_vertex(v)) worst = std::min(worst, mesh.smallest_sine_around(v));
  return worst;
}

std::vector<Index> nodes_near(const kernel::Mesh& mesh, const Candidate& candidate) {
  std::vector<Index> nodes;
  for (Index h : {candidate.h, kernel::Mesh::twin(candidate.h), candidate.k})
    if (h != kNone && mesh.face(h) != kNone)
      for (Index v : topology::nodes_of(mesh, mesh.face(h))) nodes.push_back(v);
  return nodes;
}

}  // namespace qmorph::cleanup
