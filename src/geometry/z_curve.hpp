// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <vector>

#include "geometry/vec2.hpp"
#include "qmorph/patch.hpp"

namespace qmorph {

/// The numbers of the points in the order of a Z-curve through them [Morton66]; points at the same place of the curve
/// keep their order, or are sorted by `before` if that is given.
/// What lies close together in the plane does so in this order, nearly always. Cost: linear.
std::vector<Index> along_z_curve(const std::vector<Vec2>& points, const std::function<bool(Index, Index)>& before = {});

}  // namespace qmorph
