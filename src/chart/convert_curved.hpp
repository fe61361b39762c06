// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/surface.hpp"

namespace qmorph::chart {

/// convert() and improve() of a patch that is not planar.
SurfaceWork convert_curved(const Patch& patch, const Options& options);
SurfaceWork improve_curved(const Patch& patch, const Options& options);

}  // namespace qmorph::chart
