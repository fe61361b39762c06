// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Figures as post-processing data, which Gmsh's window colours the mesh by.

#include <string>

#include "report/scene.hpp"

namespace qmorph::report {

/// Sections for the end of a .msh file (versions 2 to 4.1): $ElementData of each figure, $NodeData of the valences that
/// are not four. \pre the file has the elements and nodes under the scene's tags
std::string msh_views(const Scene& scene, bool binary);

/// The figures of the elements as a .pos file of Gmsh, for meshes in formats that have no place for data.
std::string pos_views(const Scene& scene);

}  // namespace qmorph::report
