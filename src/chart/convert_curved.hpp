// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/surface.hpp"
#include "qmorph/options.hpp"
#include "qmorph/patch.hpp"

namespace qmorph::chart {

/// convert() of a patch that is not planar.
SurfaceWork convert_curved(const Patch& patch, const Options& options);

}  // namespace qmorph::chart
