// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "chart/work_on_region.hpp"

namespace qmorph::chart {

/// work_on_region(). Where a region is not large and the result has many irregular nodes, other constants of the front
/// are tried as well, once each, and the best result is taken. \throws SurfaceError
RegionWork best_of_attempts(const CurvedRegion& region, const Options& options, Budget& budget, Task task);

}  // namespace qmorph::chart
