// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/worth.hpp"

namespace qmorph {
namespace {

/// The element's worst corner, with edges a and b: 4 a x b / (a^2 + b^2 + (a - b)^2), 1 in a square. Thesis, eq. 2.1
/// and 2.2.
double shape(const kernel::Mesh& mesh, Index f) {
  double least = 1;
  Index h = mesh.half_edge(f);
  for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h)) {
    const Vec2 a = mesh.vector(h), b = -mesh.vector(mesh.prev(h));
    least = std::min(least, 4 * cross(a, b) / (a.squaredNorm() + b.squaredNorm() + (a - b).squaredNorm()));
  }
  return least;
}

}  // namespace

Worth worth_of(const kernel::Mesh& mesh, std::size_t triangles) {
  Worth worth;
  std::size_t faces = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    if (mesh.is_quad(f)) worth.least = std::min(worth.least, mesh.smallest_sine(f));
    worth.mean += shape(mesh, f), ++faces;
  }
  if (faces > 0) worth.mean /= double(faces);
  worth.growth = kTrianglesPerQuad * double(faces) / double(triangles);
  return worth;
}

}  // namespace qmorph
