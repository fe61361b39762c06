// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Writes a patch or a result as a mesh file (MSH 2.2, text) that Gmsh and tools/draw can open.

#include <string>

#include "qmorph/patch.hpp"

namespace qmorph::test {

void dump(const Patch& patch, const std::string& path);
/// The result with the input's constraints and fixed nodes as line and point elements.
void dump(const Patch& patch, const QuadMesh& mesh, const std::string& path);

}  // namespace qmorph::test
