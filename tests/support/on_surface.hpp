// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "qmorph/patch.hpp"
#include "support/complaints.hpp"

namespace qmorph::test {

/// What of a curved result does not fit its input's triangles: "surface: ...". Elements where the input's own triangles
/// are folded (normals of neighbours more than a right angle apart) may be what they are. Without a line of the engine.
void check_on_surface(const Patch& in, const QuadMesh& out, Complaints& bad);

/// Nodes less edges plus elements.
int euler_characteristic(const std::vector<std::array<Index, 3>>& triangles,
                         const std::vector<std::array<Index, 4>>& quads);

}  // namespace qmorph::test
