// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gmsh/convert/replace.hpp"

namespace qmorph::adapter {

/// Where a smooth curve turns by few elements, a quad may have two of its sides on it: a good one as long as they are
/// straight, with a corner of nearly 180 degrees once they follow the curve. Such quads are pillowed, so that there are
/// two quads at that corner. For elements of a higher order, and linear ones that will be raised on their geometry
/// (`Mesh.ElementOrder`).
void pillow_bent_quads(const ModelMesh& mesh, ConvertedSurface& surface);

}  // namespace qmorph::adapter
