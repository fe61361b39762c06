// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gmsh's mesher, asked in a way that suits Q-Morph.

#include <string>
#include <vector>

#include "gmsh/divide/divide.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph::adapter {

/// What of a model Gmsh would mesh, and what has elements already.
struct MeshingTask {
  std::vector<int> bare;          ///< surfaces of a geometry without elements
  std::vector<int> facets;        ///< surfaces made of facets (CreateGeometry): their elements are the geometry
  std::vector<int> kept;          ///< surfaces whose elements stay
  bool kept_on_geometry = false;  ///< some of `kept` would be meshed again if Gmsh were not told
  bool compounds = false;         ///< there are some, inside which Gmsh divides curves as it likes
  bool becomes_layers = true;     ///< rows of triangles become rows of quads

  bool is_empty() const { return bare.empty() && facets.empty(); }
};

/// \param taken_as_it_is of a .msh file: facets with a geometry are its mesh
MeshingTask find_meshing_task(bool taken_as_it_is);

/// What came of it.
struct MeshedModel {
  std::vector<std::string> warnings;  ///< of Gmsh
  DivisionReport division;
  EvenReport even;  ///< where the curves have not been enough
};

/// Meshes those surfaces of the current model; see `open_model`.
/// \param keep_curves tags of curves that get the number of segments that Gmsh gives them
/// \throws InputError with Gmsh's own words
MeshedModel mesh_surfaces(const MeshingTask& task, const std::vector<int>& keep_curves);

/// Gmsh's number of "Blossom": any pairing but the simple one makes it divide curves evenly.
inline constexpr double kBlossomPairing = 1;

/// Options that would make Gmsh recombine by itself, for the time of the meshing.
struct RecombinationOff {
  ScopedOption all{"Mesh.RecombineAll", 0};
  ScopedOption algorithm{"Mesh.RecombinationAlgorithm", kBlossomPairing};
  ScopedOption subdivision{"Mesh.SubdivisionAlgorithm", 0};
};

/// Cuts the current model's mesh into partitions. \throws InputError
void partition(int count);

}  // namespace qmorph::adapter
