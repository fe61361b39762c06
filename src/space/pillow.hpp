// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <span>

#include "qmorph/export.hpp"
#include "qmorph/patch.hpp"
#include "space/result.hpp"

namespace qmorph::space {

/// Puts a row of quads around the given ones [Mitchell95], those that share an edge as one: they shrink, and the row
/// fills what they leave. So a node of the boundary that one of them had alone has two quads then. The new nodes lie on
/// the surface.
/// \param quads of the mesh that `result` is of; no others change
/// \return the mesh with the shrunken quads in their places and the new ones at the end
/// Cost: linear.
QMORPH_API QuadMesh pillow(const Patch& before, const Result& result, std::span<const Index> quads);

}  // namespace qmorph::space
