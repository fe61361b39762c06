// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>

#include "qmorph/patch.hpp"

namespace qmorph::space {

/// A curved patch with elements that are turned over among their neighbours or cross themselves, with nodes around them
/// moved so that none is: each goes to the middle of its neighbours, a few times over, and to the closest point of the
/// patch. Nothing if there are no such elements, or that does not help. Fixed nodes and those of the boundary, of
/// constraints, of the first `kept` quads and of edges between good elements that are sharper than `crease_angle`
/// (radians) stay; where that does not help, such edges of elements that share a node with a bad one do not count.
/// Cost: linear.
std::optional<Patch> put_right(const Patch& patch, std::size_t kept, double crease_angle);

/// Brings the nodes of what a patch was made into, but those that did not move, to the closest points of the patch.
void lay_onto(const Patch& patch, QuadMesh& mesh);

}  // namespace qmorph::space
