// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/complaints.hpp"

#include <fmt/format.h>

#include <optional>

#include "geometry/describe.hpp"
#include "gmsh/model/coincident_nodes.hpp"
#include "gmsh/model/overlap.hpp"
#include "qmorph/check.hpp"
#include "qmorph/error.hpp"
#include "quality/directed_size.hpp"
#include "space/corners.hpp"
#include "space/element_sides.hpp"

namespace qmorph::adapter {

void refuse_bad_quads(const SurfaceMesh& surface) {
  for (const SurfacePart& part : surface.parts)
    if (const std::optional<BadQuad> bad = find_bad_quad(part.patch))
      throw SurfaceError(
          fmt::format("its quad {} is inverted or not convex at {}; --cleanup-only (improve_quads()) mends such quads",
                      part.quad_tags[bad->quad], describe(bad->place)),
          {.kind = ErrorKind::bad_element,
           .place = bad->place,
           .subject = ErrorSubject{ErrorSubject::Kind::element, part.quad_tags[bad->quad]}});
}

void refuse_crossed_quads(const SurfaceMesh& surface) {
  for (const SurfacePart& part : surface.parts) {
    const Patch& patch = part.patch;
    std::optional<space::ElementSides> sides;
    for (Index q = 0; q < patch.quads.size(); ++q) {
      space::Corners<4> p;
      for (std::size_t k = 0; k < 4; ++k) p[k] = patch.points[patch.quads[q][k]];
      if (!space::crosses_itself(p)) continue;
      if (!sides) sides.emplace(patch.points.size(), patch.triangles, patch.quads);
      const Index first = 4 * (Index(patch.triangles.size()) + q);
      const auto is_outer = [&](Index k) { return sides->opposite(first + k) == kNone; };
      if ((is_outer(0) && is_outer(2)) || (is_outer(1) && is_outer(3))) throw crossed_quad(part.quad_tags[q], p);
    }
  }
}

void warn_of_loose_parts(const ClassifiedMesh& model, std::vector<std::string>& warnings) {
  const CoincidentNodes found = find_coincident_nodes(model.mesh, model.use);
  if (found.count)
    warnings.push_back(
        fmt::format("{} node{} where another one is, as {}: the elements there are not joined. Unless that is meant, "
                    "as in a crack, 'Coherence;' in the script of a geometry joins them, or 'Coherence Mesh;' in one "
                    "that merges the mesh",
                    found.count, found.count == 1 ? " lies" : "s lie", describe_node(model.mesh, found.first)));
  if (const auto overlap = find_overlap(model.mesh))
    warnings.push_back(
        fmt::format("surface {} lies over another one, or over itself, at {}: take one of the two out, or fuse them "
                    "with 'Coherence;' in the script of the geometry",
                    overlap->surface, describe(overlap->where)));
}

std::string describe_lost_size(const std::vector<DirectedSize>& sizes) {
  const DirectedSize size = median(sizes);
  if (largest_ratio(size) <= kLargestSizeRatio) return {};
  return fmt::format(
      "its quads are {:.2f} times as long as its triangles in the direction in which these are longest, and {:.2f} "
      "times in "
      "the other (medians)",
      size.along, size.across);
}

}  // namespace qmorph::adapter
