// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A region of a curved surface becomes quads.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "chart/curved_region.hpp"
#include "chart/part_work.hpp"

namespace qmorph::chart {

struct RegionWork {
  SurfaceMesh mesh;  ///< vertices of the region keep their numbers
  ConversionReport report;
  std::vector<SurfaceMesh> stages;  ///< before the last one; none if nobody wants them
  std::array<double, kStages> seconds{};
  std::vector<std::unique_ptr<FrontObserver>> fronts;
};

/// What may be spent on a region.
struct Effort {
  double allowed = 0;     ///< work in the charts of a try, more or less (engine/allowance.hpp)
  std::size_t spent = 0;  ///< work of all tries so far, in space as well

  /// Whether another try is worth its work: not where tries take long because nothing about the surface is right.
  /// `times`: how much more than usual it is worth.
  bool has_more_for(std::size_t triangles, double times = 1) const;
};

/// Cuts the region into parts that lie flat, works on each in its chart, joins them, cleans the interfaces, and smooths
/// and mends in space. What fails, or is doubtful, is tried again in other ways.
/// \throws SurfaceError
RegionWork work_on_region(const CurvedRegion& region, const Options& options, Effort& effort, Task task);

/// The same, tried once, and each part as well: nothing if that fails or is doubtful.
std::optional<RegionWork> try_region(const CurvedRegion& region, const Options& options, Effort& effort, Task task);

}  // namespace qmorph::chart
