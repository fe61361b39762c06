#include "qmorph/convert.hpp"

namespace qmorph {

QuadMesh convert(const Patch& patch, const Options&) {
  QuadMesh mesh;  // placeholder until the engine is in: the input as it is
  mesh.points = patch.points;
  mesh.source.resize(patch.points.size());
  for (Index i = 0; i < mesh.source.size(); ++i) mesh.source[i] = i;
  mesh.triangles = patch.triangles;
  mesh.quads = patch.quads;
  return mesh;
}

}  // namespace qmorph
