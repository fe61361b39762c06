// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Before Gmsh is asked.

#include <string>

namespace qmorph::adapter {

/// \throws InputError if there is no such file, or it is a directory, empty, or not readable.
void check_readable(const std::string& path);

/// By its name: a format for meshes alone, which is read in a time that its size tells. Scripts, geometries and what
/// has another name are not.
bool is_mesh_file(const std::string& path);

/// By its name: a script, as Gmsh writes and calls them, or a name without an extension.
bool is_script(const std::string& path);

/// By its name: a geometry in one of the exchange formats.
bool is_cad_file(const std::string& path);

}  // namespace qmorph::adapter
