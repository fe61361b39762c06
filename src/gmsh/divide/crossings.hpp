// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Boundaries that would cross themselves as they are to be divided. Gmsh cannot mesh inside, and versions from 4.9 on
/// may never stop trying.

#include <vector>

#include "gmsh/divide/curves.hpp"

namespace qmorph::adapter {

/// Whether the segments of a curve turn back somewhere: one with a cusp, or with a loop smaller than a segment, crosses
/// itself with nodes in one place and not with nodes in another.
bool folds_back(const DividedCurve& curve, int segments);

/// Whether the boundary of a planar surface crosses or touches itself; `segments` by curve of the model. Cost: the
/// square of the segments; beyond 3000 the question stays open.
bool crosses_itself(const CurveModel& model, const BoundedSurface& surface, const std::vector<int>& segments);

}  // namespace qmorph::adapter
