// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "chart/interfaces.hpp"

namespace qmorph::chart {

/// A mesh of triangles with a node in the middle of each edge inside, but for those that `kept` has: where a few
/// triangles turn sharply there is no room for quads between their nodes alone.
SurfaceMesh refined(const SurfaceMesh& mesh, const std::vector<Edge>& kept);

}  // namespace qmorph::chart
