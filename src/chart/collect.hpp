// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "chart/curved_region.hpp"

namespace qmorph::chart {

/// Puts the regions of a patch together: kept nodes of the patch in their order, then new ones; its quads first.
QuadMesh collect(const Patch& patch, const std::vector<CurvedRegion>& regions,
                 const std::vector<const SurfaceMesh*>& meshes);

}  // namespace qmorph::chart
