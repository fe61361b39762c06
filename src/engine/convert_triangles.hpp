// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "engine/surface.hpp"

namespace qmorph {

/// All triangles by the front, beside the quads that are there. Regions that no valid quads are found for are left out
/// of the result, and their nodes are marked in `stuck`; if that is null, they are an error.
SurfaceWork convert_triangles(const Patch& patch, const std::optional<Plane>& plane, const Options& options,
                              Budget& budget, std::vector<bool>* stuck);

}  // namespace qmorph
