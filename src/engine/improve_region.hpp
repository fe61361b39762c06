// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One region of triangles and quads becomes better quads.

#include "engine/budget.hpp"
#include "engine/record.hpp"
#include "engine/regions.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/options.hpp"
#include "qmorph/report.hpp"

namespace qmorph {

/// A region whose elements are valid now, as triangles alone and as the mesh that it is.
struct ImproveStart {
  Region region;
  kernel::Mesh mesh;
};

/// Makes the elements of a mesh of the region valid. \throws SurfaceError for one that is turned over all the same
ImproveStart start_improving(const Region& region, kernel::Mesh mesh, const Plane& plane, const Options& options);

/// The first of several results that is in no way worse than `input`, the mesh as it came: made anew by all stages but
/// the front (and that, too, where there is no other way); no more changed than triangles ask for; as it was; made from
/// triangles alone, whatever quads were there. Where triangles can go in none of these ways, the one with the fewest
/// poor quads, and it is counted. All for about as much work as the budget has left. \throws SurfaceError if no
/// valid result was found
kernel::Mesh improve_region(const ImproveStart& start, const kernel::Mesh& input, const Plane& plane,
                            const Options& options, Budget& budget, ConversionReport& report, Record& record);

}  // namespace qmorph
