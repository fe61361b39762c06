// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "chart/interfaces.hpp"

namespace qmorph::chart {

/// With fewer irregular nodes per face than this, a mesh has few of them.
inline constexpr double kFewIrregular = 0.01;

/// By node: free, on no boundary and no crease, and with other than four faces.
std::vector<char> irregular_nodes(const SurfaceMesh& mesh, const std::vector<Edge>& creases);

}  // namespace qmorph::chart
