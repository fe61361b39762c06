// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <numbers>
#include <utility>

#include "qmorph/patch.hpp"
#include "space/background.hpp"

namespace qmorph::space {

/// Edges along which two triangles of a surface meet at more than `angle` (radians, between their normals), lower node
/// first, sorted. Triangles without height do not count.
std::vector<std::pair<Index, Index>> find_creases(const Background& surface, double angle);

/// From where on edges of a patch are creases, if `asked` is what Options say: never if it is smooth.
inline double crease_angle_of(const Patch& patch, double asked) { return patch.is_smooth ? std::numbers::pi : asked; }

}  // namespace qmorph::space
