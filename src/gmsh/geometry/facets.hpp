// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gmsh/model/patches.hpp"

namespace qmorph::adapter {

/// Whether the edges of a surface's triangles that are sharper than `angle` (radians, between normals) are none of the
/// geometry: the geometry has normals there that change little by little, so that only the triangles are coarse. False
/// without such edges, and without a geometry.
bool has_only_facets(const ModelMesh& mesh, const SurfaceMesh& surface, double angle);

}  // namespace qmorph::adapter
