// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A region of a curved surface becomes quads.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "chart/curved_region.hpp"
#include "chart/lay_grid.hpp"
#include "chart/part_work.hpp"
#include "qmorph/error.hpp"

namespace qmorph::chart {

struct RegionWork {
  SurfaceMesh mesh;  ///< vertices of the region keep their numbers
  ConversionReport report;
  std::vector<SurfaceMesh> stages;  ///< before the last one; none if nobody wants them
  std::array<double, kStages> seconds{};
  std::vector<std::unique_ptr<FrontObserver>> fronts;
};

/// Whether another try of a region of so many triangles is worth its work, which all tries draw from one budget: not
/// where tries take long because nothing about the surface is right. `times`: how much more than usual it is worth.
bool has_more_for(const Budget& budget, std::size_t triangles, double times = 1);

struct DividedRegion;
/// Of what several tries of one region begin with alike, made by the first that needs it; null before that.
using SharedDivision = std::shared_ptr<const DividedRegion>;

/// So many elements are turned over that it is not layers beside the region that are to blame.
class HopelessRegion : public SurfaceError {
 public:
  using SurfaceError::SurfaceError;
};

/// Cuts the region into parts that lie flat, works on each in its chart, joins them, cleans the interfaces, and smooths
/// and mends in space. What fails, or is doubtful, is tried again in other ways.
/// \throws SurfaceError
RegionWork work_on_region(const CurvedRegion& region, const Options& options, Budget& budget, Task task,
                          SharedDivision& shared);

/// The same, tried once, and each part as well: nothing if that fails or is doubtful.
std::optional<RegionWork> try_region(const CurvedRegion& region, const Options& options, Budget& budget, Task task,
                                     SharedDivision& shared);

/// The region as a grid (lay_grid.hpp), smoothed and mended in space: nothing if it is none, or an element is doubtful.
std::optional<RegionWork> try_grid(const CurvedRegion& region, const Options& options, Budget& budget, GridSizes sizes);

}  // namespace qmorph::chart
