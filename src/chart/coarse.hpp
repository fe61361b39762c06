// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How well a large piece lies flat, from far fewer triangles.

#include <optional>

#include "chart/surface_mesh.hpp"

namespace qmorph::chart {

/// The distortion that the piece would have, laid flat, nearly. Nothing if it is too small or too intricate for that to
/// be seen from a few of its points. Cost: linear, and a small share of flattening it.
std::optional<double> coarse_distortion(const Piece& piece);

}  // namespace qmorph::chart
