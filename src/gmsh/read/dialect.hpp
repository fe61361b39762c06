// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a file of another program's format has that Gmsh's reader of that format does not know.

#include <string>

namespace qmorph::adapter {

/// Why Gmsh is likely to fail on a file, judged by how it begins, with what to do: "; it is ...: write ...", to end a
/// message. Empty if there is nothing to say.
std::string describe_dialect(const std::string& path);

/// Whether a file of VTK has data on points or cells, which Gmsh's reader leaves out.
bool has_vtk_data(const std::string& path);

}  // namespace qmorph::adapter
