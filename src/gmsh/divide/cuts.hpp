// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Curves in pieces: where a corner lies close to the middle of a curve, across a thin part of a surface, a node of
/// the curve is to face it; and where two curves come close to each other and part again, a node of each one of the
/// other. Else quads between them lean, the more the thinner it is there.

#include <vector>

#include "gmsh/divide/curves.hpp"

namespace qmorph::adapter {

/// The model with such curves in pieces, which have the curve's tag and follow one another. The points between pieces
/// have tags of their own, below 0. Curves for which `may_cut` is false and those with images stay whole.
CurveModel cut_at_narrow_places(const CurveModel& model, const std::vector<bool>& may_cut);

}  // namespace qmorph::adapter
