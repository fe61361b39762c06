// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "chart/work_on_region.hpp"

namespace qmorph::chart {

/// work_on_region(). Where a region is not large and the result has many irregular nodes, other constants of the front
/// are tried as well, once each, and the best result is taken. \throws SurfaceError
RegionWork best_of_attempts(const CurvedRegion& region, const Options& options, Budget& budget, Task task);

/// The same for a region of a smooth surface whose triangles stand at sharp angles: the better of what it becomes as it
/// is, and `faceted`, with their edges as creases. \throws SurfaceError
RegionWork best_with_or_without_creases(const CurvedRegion& smooth, const CurvedRegion& faceted, const Options& options,
                                        Budget& budget, Task task);

}  // namespace qmorph::chart
