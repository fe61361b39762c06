// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "chart/surface_mesh.hpp"

namespace qmorph::chart {

/// The boundary of a piece: its points, loop by loop, each in order with the piece on the left.
std::vector<std::vector<Index>> loops_of(const Piece& piece);

/// Points less edges plus faces: 2 less loops for what can lie in the plane.
int euler_characteristic(const Piece& piece);

/// It could lie in the plane: no handle, and a boundary.
bool is_planar_topology(const Piece& piece);

/// Sets of faces that hang together across sides that are not cut, by their lowest face.
std::vector<std::vector<Index>> components(const std::vector<Index>& faces, const std::vector<Index>& opposite,
                                           const std::vector<bool>& is_cut);

/// By point of a piece: 2 pi less the angles of the faces around it; pi less them on the boundary.
std::vector<double> angle_defects(const Piece& piece);

}  // namespace qmorph::chart
