// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/worth.hpp"

#include "topology/edits.hpp"

namespace qmorph {

Worth worth_of(const kernel::Mesh& mesh, std::size_t triangles) {
  Worth worth;
  std::size_t faces = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    if (mesh.is_quad(f)) worth.least = std::min(worth.least, mesh.smallest_sine(f));
    worth.mean += topology::worst_corner_shape(mesh, f), ++faces;
  }
  if (faces > 0) worth.mean /= double(faces);
  worth.growth = kTrianglesPerQuad * double(faces) / double(triangles);
  return worth;
}

bool is_worth_more(const Worth& one, const Worth& other) {
  constexpr double kMostGrowth = 2.5, kAccepted = 0.4;
  const auto mends = [](const Worth& a, const Worth& b) {
    return a.least >= kAccepted && b.least < kRefused && a.growth <= kMostGrowth;
  };
  return mends(one, other) || (one.sum() > other.sum() && !mends(other, one));
}

bool is_better(const Worth& one, const Worth& other) { return one.least >= other.least && one.sum() > other.sum(); }

double mean_sine(const kernel::Mesh& mesh) {
  double sum = 0;
  std::size_t faces = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f)) sum += mesh.smallest_sine(f), ++faces;
  return sum / double(std::max<std::size_t>(1, faces));
}

std::size_t count_poor(const kernel::Mesh& mesh, double sine) {
  std::size_t count = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    count += mesh.is_live_face(f) && mesh.is_quad(f) && mesh.smallest_sine(f) < sine;
  return count;
}

bool has_irregular_nodes(const kernel::Mesh& mesh) {
  const std::vector<Index> valences = mesh.valences();
  for (Index v = 0; v < valences.size(); ++v)
    if (mesh.is_live_vertex(v) && !mesh.is_boundary(v) && valences[v] != 4) return true;
  return false;
}

}  // namespace qmorph
