// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/attempt.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace qmorph::cleanup {

Worth worth_around(const kernel::Mesh& mesh, const std::vector<Index>& nodes) {
  return worth_of(mesh, topology::faces_around(mesh, nodes));
}

Worth worth_of(const kernel::Mesh& mesh, const std::vector<Index>& faces) {
  Worth worth;
  worth.faces = faces.size();
  double sum = 0;
  for (Index f : faces) {
    const double sine = mesh.smallest_sine(f);
    worth.worst = std::min(worth.worst, sine);
    sum += sine;
  }
  if (!faces.empty()) worth.mean = sum / double(faces.size());
  return worth;
}

Worth best_worth_around(const kernel::Mesh& mesh, const std::vector<Index>& nodes) {
  constexpr double kRounding = 1e-9;
  Worth worth;
  for (Index v : nodes) {
    if (!mesh.is_live_vertex(v) || !mesh.is_boundary(v)) continue;
    const Index out = mesh.out(v), quads = mesh.valence(v) - 1;
    const double angle = ccw_angle(-mesh.vector(mesh.prev(out)), mesh.vector(out));
    if (quads > 0 && angle > 0) worth.worst = std::min(worth.worst, std::sin(angle / quads) + kRounding);
  }
  return worth;
}

std::vector<Index> worst_first(const kernel::Mesh& mesh, std::vector<Index> faces) {
  std::vector<std::pair<double, Index>> sines;
  for (Index f : faces) sines.emplace_back(mesh.smallest_sine(f), f);
  std::sort(sines.begin(), sines.end());
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = sines[i].second;
  return faces;
}

std::vector<Index> nodes_near(const kernel::Mesh& mesh, const Candidate& candidate) {
  std::vector<Index> nodes;
  for (Index h : std::array<Index, 3>{candidate.h, kernel::Mesh::twin(candidate.h), candidate.k})
    if (h != kNone && mesh.face(h) != kNone)
      for (Index v : topology::nodes_of(mesh, mesh.face(h))) nodes.push_back(v);
  return nodes;
}

}  // namespace qmorph::cleanup
