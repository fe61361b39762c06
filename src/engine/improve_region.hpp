// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One region of triangles and quads becomes better quads.

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

/// All stages but the front; that, too, if there is no other way. Uses up `start`; `input` is the mesh as it came, if somebody wants
/// stages. \throws SurfaceError if no valid result was found
kernel::Mesh improve_region(ImproveStart& start, const kernel::Mesh& input, const Plane& plane, const Options& options,
                            ConversionReport& report, Record& record);

}  // namespace qmorph
