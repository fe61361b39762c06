// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/regions.hpp"

namespace qmorph {

/// Where triangles are stretched, all of them about as much and the same way, the plane with axes in which they are
/// not: quads that are square there have the sizes that the triangles have along and across. Else the plane as it is.
Plane unstretched(const Plane& plane, const Patch& patch);

}  // namespace qmorph
