// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <set>
#include <vector>

namespace qmorph::adapter {

/// Gmsh gives a surface's elements the side of the geometry's normal, or the other one if a script says so. It looks at
/// one element only, and on a coarse mesh of a bent surface that one may be askew: then all of them face the wrong way.
/// Turns those surfaces over.
/// \param surfaces of a geometry, just meshed by Gmsh
/// \param reversed those that the script wants the other way
/// \return what has been turned
std::vector<int> face_as_geometry(const std::vector<int>& surfaces, const std::set<int>& reversed);

}  // namespace qmorph::adapter
