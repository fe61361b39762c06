// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How well a large piece lies flat, from far fewer triangles.

#include <optional>

#include "chart/flatten.hpp"
#include "chart/surface_mesh.hpp"

namespace qmorph::chart {

/// The distortion that the piece would have, laid flat, nearly. Nothing if it is too small or too intricate for that to
/// be seen from a few of its points. Cost: linear, and a small share of flattening it.
std::optional<double> coarse_distortion(const Piece& piece);

/// The piece laid flat by a few of its points first, between which the others are placed. Nothing if it is too small or
/// too intricate for that. Cost: linear.
/// \param surface the piece's halves
std::optional<Flattening> flatten_by_few(const Piece& piece, const space::Background& surface);

}  // namespace qmorph::chart
