// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "qmorph/patch.hpp"

namespace qmorph::chart {

/// Edges of a patch along which two triangles meet at more than `angle` (radians, between their normals). Triangles without height
/// have no say. Each edge once, lower node first.
std::vector<std::array<Index, 2>> find_creases(const Patch& patch, double angle);

}  // namespace qmorph::chart
