// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// MSH 2.2, written by ourselves.

#include <string>

#include "gmsh/read/msh/msh2_groups.hpp"

namespace qmorph::adapter {

/// Writes the current model as MSH 2.2 with the tags of its nodes and elements. Gmsh's own writer numbers both anew
/// in an order that depends on the physical groups, so that points and curves that came from a file would
/// come out with other tags.
/// What was taken apart on reading is put together again: elementary tags are the file's, and an element in several
/// groups, of which version 2 stores one, is written once for each.
/// \pre there are no ghost cells
/// \throws OutputError
void write_msh2(const std::string& path, bool binary, const Msh2Origin& origin);

}  // namespace qmorph::adapter
