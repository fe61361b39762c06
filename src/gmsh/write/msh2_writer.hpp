// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// MSH 2.2, written by ourselves.

#include <string>

#include "gmsh/read/msh/msh2_groups.hpp"

namespace qmorph::adapter {

/// Writes the current model as MSH 2.2, keeping the tags of its nodes and elements. Gmsh's own writer renumbers both in
/// an order that depends on the physical groups, so that points and curves from a file would get other tags.
/// What was split on reading is joined again: elementary tags are those of the file, and an element in several groups
/// is written once for each, since version 2 stores one group for an element.
/// \pre there are no ghost cells
/// \throws OutputError
void write_msh2(const std::string& path, bool binary, const Msh2Origin& origin);

}  // namespace qmorph::adapter
