// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Thin regions that run out in a sharp corner: crescents, wedges, slivers between fillets.

#include <optional>

#include "engine/regions.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::bands {

/// Up to four rows of quads from the sharpest corner of the boundary on, between the two sides that meet there, up to
/// the other end, be it a corner or a side: a kite in each sharp corner, and a row more or less where one side has a
/// node more or the region gets wider. Best is the least sum of 1 / scaled Jacobian, by dynamic programming over the
/// pairs of nodes that face each other. Nothing if there is no corner under 45 degrees, the boundary is more than one
/// loop, odd or too long, a fixed node is inside, or there is no way. Cost: at most a million quads looked at.
std::optional<kernel::Mesh> lay_blade(const Region& region);

}  // namespace qmorph::bands
