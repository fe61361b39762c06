// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "engine/surface.hpp"

namespace qmorph {

/// Layers stay the quads that they are, and the front has what is left. Where that is too odd a shape for quads, the
/// layers around it are left to the front as well, and at last all of them.
SurfaceWork convert_with_layers(const Patch& patch, const std::optional<Plane>& plane, const Options& options,
                                Budget& budget);

}  // namespace qmorph
