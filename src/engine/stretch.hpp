// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/regions.hpp"

namespace qmorph {

/// Where all triangles are stretched by about as much in the same direction, the plane with axes in which they are not
/// stretched: quads that are square there have the triangles' sizes along and across. Otherwise the plane as it is.
Plane unstretched(const Plane& plane, const Patch& patch);

}  // namespace qmorph
