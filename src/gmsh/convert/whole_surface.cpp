// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/whole_surface.hpp"

namespace qmorph::adapter {

Patch whole_surface(const SurfaceMesh& surface) {
  Patch whole;
  for (const SurfacePart& part : surface.parts) {
    const Index first = Index(whole.points.size());
    whole.points.insert(whole.points.end(), part.patch.points.begin(), part.patch.points.end());
    for (const auto& [a, b, c] : part.patch.triangles) whole.triangles.push_back({first + a, first + b, first + c});
    for (const auto& [a, b, c, d] : part.patch.quads)
      whole.quads.push_back({first + a, first + b, first + c, first + d});
  }
  return whole;
}

QuadMesh as_result(const Patch& patch) {
  return {patch.points, std::vector<Index>(patch.points.size(), kNone), patch.triangles, patch.quads};
}

}  // namespace qmorph::adapter
