// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Quads that were made in a chart, in the plane that they were made for.

#include <vector>

#include "kernel/mesh.hpp"
#include "stretch/log_metric.hpp"

namespace qmorph::stretch {

/// Moves nodes so that quads have good shapes by the metric, and so that those whose sides run along its axes and
/// across are rectangles: a corner that is nearly right by the metric is far from that in the plane, and the other way
/// round it costs little. Quads that are turned over, or poor by the metric, are raised before.
/// No quad that is valid becomes invalid, and none gets poor by the metric. Cost: linear.
/// \param metrics by vertex slot
void straighten(kernel::Mesh& mesh, const std::vector<LogMetric>& metrics);

}  // namespace qmorph::stretch
