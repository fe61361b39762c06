// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Further files for a model.

#include <string>
#include <vector>

#include "gmsh/views/views.hpp"

namespace qmorph::adapter {

/// Merges a file into the current model, as Gmsh does. But where numbers of its mesh already stand for something else,
/// which makes Gmsh write files that it cannot read, the file's nodes, elements and entities get numbers above those
/// that are there. Physical groups with one number are one group. Nodes of both with the same number and place, if all
/// are so, are the same nodes.
/// \return data of the file, where its numbers have changed; else Gmsh has it
/// \throws InputError, also if nodes of the file are put on an entity of a geometry and are elsewhere
std::vector<ViewStep> merge_file(const std::string& path);

/// To be called after the last file. \throws InputError if some surfaces have elements and others, of a geometry, have
/// none or have given their numbers to a mesh: they would be lost
void check_geometry_kept();

}  // namespace qmorph::adapter
