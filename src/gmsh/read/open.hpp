// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// From a file to a model with triangles.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gmsh/divide/divide.hpp"
#include "gmsh/read/msh/file.hpp"
#include "gmsh/read/msh/msh2_groups.hpp"
#include "gmsh/views/views.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph::adapter {

/// Gmsh's 2D algorithm where the user does not choose one: Frontal-Delaunay. When it was chosen, the mean scaled
/// Jacobian of the quads over the geometries of geo/ was 0.970 to 0.973 and the irregular share 5.5 to 6.4 % with 6, 5,
/// 1, 8 and 9; 6 and 5 are the fastest, and 9 (pack), best by a hair on average, had the worst element by far (0.06
/// against 0.39).
inline constexpr int kDefaultAlgorithm = 6;

/// What `open_model` found.
struct OpenedModel {
  MshHeader msh;                                 ///< version 0: not a .msh file
  bool had_mesh = false;                         ///< surfaces have elements from a file, not from Gmsh's mesher
  bool compounds = false;                        ///< a script makes some
  bool meshed = false;                           ///< by Gmsh, something
  Msh2Origin origin;                             ///< of a file of MSH 2 that had to be taken apart
  MeshData views;                                ///< data on the mesh of the file
  std::optional<std::vector<ViewStep>> carried;  ///< `views` on the quads, if that has been done already
  DivisionReport division;                       ///< of the curves, where Gmsh has meshed them
  EvenReport even;                               ///< what else was divided then
  std::vector<std::string> warnings;
  std::vector<std::string> sources;  ///< files that Gmsh has said it reads
  double open_seconds = 0, mesh_seconds = 0;
};

/// How to open.
struct OpenOptions {
  std::vector<std::string> merged{};  ///< further files, merged after the first and before anything is meshed
  std::string background{};           ///< file with a view that says what sizes elements have, or empty
  bool no_meshing = false;            ///< surfaces without elements stay so
  bool ignore_periodicity = false;    ///< of the file
  bool becomes_layers = true;         ///< rows of triangles become rows of quads: Gmsh need not make these
  std::vector<int> keep_curves{};     ///< that get as many segments as Gmsh gives them
  std::function<void()> when_read{};  ///< called once all is read and before Gmsh meshes; may be empty
};

/// Opens a file with Gmsh and meshes surfaces that have a geometry and no elements yet, or whose geometry is made of
/// facets: curves first, divided so that surfaces can become quads without a triangle left (divide.hpp); then surfaces
/// with triangles. A .msh file with facets that have a geometry is taken as it is. Surfaces that the
/// script wants transfinite or extruded *and* recombined come as quads.
/// \throws InputError with Gmsh's own words if the file cannot be opened, understood, or meshed.
OpenedModel open_model(const std::string& path, const OpenOptions& options = {});

}  // namespace qmorph::adapter
