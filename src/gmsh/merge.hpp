#pragma once
/// Further files for a model.

#include <string>
#include <vector>

#include "gmsh/views.hpp"

namespace qmorph::adapter {

/// Merges a file into the current model, as Gmsh does. But where numbers of its mesh already stand for something else,
/// which makes Gmsh write files that it cannot read, the file's nodes, elements and entities get numbers above those
/// that are there. Physical groups with one number are one group. Nodes of both with the same number and place, if all
/// are so, are the same nodes.
/// \return data of the file, where its numbers have changed; else Gmsh has it
/// \throws InputError
std::vector<ViewStep> merge_file(const std::string& path);

}  // namespace qmorph::adapter
