// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/improve_region.hpp"

#include <optional>
#include <utility>

#include "engine/mixed.hpp"
#include "engine/pipeline.hpp"
#include "engine/prepare.hpp"

namespace qmorph {

ImproveStart start_improving(const Region& region, kernel::Mesh mesh, const Plane& plane, const Options& options) {
  ImproveStart start{region, std::move(mesh)};
  mend_quads(start.mesh, options.smoothing, plane);
  repair_input(start.mesh, plane);
  take_triangles(start.mesh, start.region);
  return start;
}

kernel::Mesh improve_region(ImproveStart& start, const kernel::Mesh& input, const Plane& plane, const Options& options,
                            ConversionReport& report, Record& record) {
  Pipeline pipeline(options, report, record, input);
  kernel::Mesh mesh = std::move(start.mesh);
  pipeline.finish(mesh);
  const std::optional<SurfaceError> fault = find_fault(mesh, start.region, plane);
  if (!fault) return mesh;

  // What quads leave no room for may be possible without them.
  kernel::Mesh triangles(start.region.points, start.region.triangles, start.region.open);
  for (Index v : start.region.fixed) triangles.set_fixed(v);
  pipeline.advance_front(triangles, plane);
  pipeline.finish(triangles);
  if (find_fault(triangles, start.region, plane)) throw *fault;
  return triangles;
}

}  // namespace qmorph
