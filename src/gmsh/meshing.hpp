#pragma once
/// Gmsh's mesher, asked in a way that suits Q-Morph.

#include <string>
#include <vector>

namespace qmorph::adapter {

/// Meshes the surfaces of the current model; see `open_model`.
/// \throws InputError with Gmsh's own words
/// \return Gmsh's warnings
std::vector<std::string> mesh_surfaces();

}  // namespace qmorph::adapter
