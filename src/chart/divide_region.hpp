// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A region in parts that lie flat: what each try of it begins with.

#include <vector>

#include "chart/curved_region.hpp"
#include "chart/divide.hpp"
#include "chart/ground.hpp"
#include "chart/interfaces.hpp"

namespace qmorph::chart {

struct DividedRegion {
  SurfaceMesh mesh;             ///< the region's triangles, but for those that straight interfaces have changed
  std::vector<Edge> creases;    ///< in order
  std::vector<Edge> interface;  ///< edges between parts, in order
  Division division;            ///< each part is laid out
  double work = 0;
};

struct RegionDivision {
  bool straightens = true;  ///< interfaces, where that turns no part over; else they run along the triangles' edges
  int refinings = 0;        ///< how often triangles are cut in four first
  double most_work = 0;     ///< to straighten, more or less
};

/// Has nothing to do with the front: tries that differ by that alone can share it.
DividedRegion divide_region(const CurvedRegion& region, const Ground& ground, const RegionDivision& settings);

/// Whether a part has no good chart.
inline bool is_turned_over(const LaidOut& part) { return part.chart.flattening().flipped > 0; }

}  // namespace qmorph::chart
