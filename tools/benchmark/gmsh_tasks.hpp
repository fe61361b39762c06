// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What is measured beside Gmsh, each for a process of its own (apart.hpp). Files are MSH 4.1, binary.

#include <string>

#include "apart.hpp"
#include "triangulations.hpp"

namespace benchmark {

/// Puts triangles into a Gmsh model, surfaces with the curves and points that bound them, and writes it.
Figures write_triangles(const Triangulation& mesh, const std::string& path);

/// Has Gmsh make about this many triangles itself, in the domain of Kind::even (algorithm 6), and writes them.
Figures gmsh_meshes(double wanted, const std::string& path);

/// Turns a file of triangles into a file of quads by Gmsh's own recombination: `algorithm` 0 is the simple one, 1
/// Blossom.
Figures gmsh_recombines(const std::string& in, const std::string& out, int algorithm);

/// The same by qmorph::gmsh::recombine().
Figures qmorph_recombines(const std::string& in, const std::string& out, int threads);

}  // namespace benchmark
