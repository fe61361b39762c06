// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "chart/surface_mesh.hpp"

namespace qmorph::chart {

/// By face of the piece: which side of a plane it lies on that cuts the piece in two along a short curve, which meets
/// the outline squarely. `share` of the faces should lie behind. Teeth are evened out.
std::vector<char> sides_of_best_plane(const Piece& piece, double share);

}  // namespace qmorph::chart
