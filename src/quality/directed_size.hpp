// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How long quads are along and across the stretch of the triangles that they take the place of.

#include <array>
#include <span>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/patch.hpp"
#include "qmorph/report.hpp"

namespace qmorph {

/// At some hundred triangles of `before` or fewer, evenly chosen, so that what is lost where quads are few and large is
/// seen. By a triangle with sides e, an edge v has the squared length v S^-1 v with S = 2/3 sum e e^T: its own sides
/// are 1 then, and so are all sides of a rectangle that is cut in halves. Where the triangles around are not stretched
/// in one direction, S is the mean of theirs, since a thin one among them means nothing.
/// Cost: a search for each quad in a tree of what was chosen, which takes some 50 ns.
QMORPH_API std::vector<DirectedSize> directed_sizes(const Patch& before, const std::vector<Eigen::Vector3d>& points,
                                                    std::span<const std::array<Index, 4>> quads);

/// Median of each of the two; 1 if there is nothing.
QMORPH_API DirectedSize median(const std::vector<DirectedSize>& sizes);

/// The larger of the two, each of them or its inverse, whichever is above 1.
QMORPH_API double largest_ratio(const DirectedSize& size);

/// If sizes differ by more than this, they count as not kept.
inline constexpr double kLargestSizeRatio = 1.5;

}  // namespace qmorph
