// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gmsh/model/patches.hpp"
#include "qmorph/patch.hpp"

namespace qmorph::adapter {

/// All parts of a surface as one patch, without constraints.
Patch whole_surface(const SurfaceMesh& surface);

/// The elements of a patch as a result with nodes of unknown origin.
QuadMesh as_result(const Patch& patch);

}  // namespace qmorph::adapter
