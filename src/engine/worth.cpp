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

}  // namespace qmorph
