// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/surface.hpp"

namespace qmorph::chart {

/// convert() and improve() of a patch that is not planar. Regions that no valid quads are found for are left out of the
/// result, and their nodes are marked in `stuck`; if that is null, or there is no hope of any, they are an error.
SurfaceWork convert_curved(const Patch& patch, const Options& options, Budget& budget, std::vector<bool>* stuck);
SurfaceWork improve_curved(const Patch& patch, const Options& options, Budget& budget);

}  // namespace qmorph::chart
