// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "bands/find_band.hpp"
#include "bands/plan_rows.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::bands {

/// The quads of a thin band, in rows from one side to the other. Where its sides have different numbers of nodes, rows
/// begin and end on the way. An odd boundary gets one triangle. Boundary nodes keep their numbers; those inside are
/// half-way between the sides, and want smoothing. Nothing if the sides are farther apart than
/// `largest_gap`, in edges, or no plan is found. Cost:
/// linear.
std::optional<kernel::Mesh> lay_rows(const Band& band, const std::vector<Vec2>& points, const RowCosts& costs,
                                     double largest_gap = kLargestGap);

}  // namespace qmorph::bands
