// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What convert() and improve() have in common: a surface is laid into its plane, its regions are worked on one by one,
/// and what they have become is put together.

#include <functional>
#include <optional>
#include <vector>

#include "engine/budget.hpp"
#include "engine/record.hpp"
#include "engine/regions.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/options.hpp"
#include "qmorph/patch.hpp"

namespace qmorph {

/// A surface in its plane, cut into regions. `patch` must outlive it.
struct Surface {
  /// \throws SurfaceError as convert() does
  Surface(const Patch& patch, const Plane& plane);

  const Patch& patch;
  Plane plane;
  std::vector<Vec2> plane_points;
  std::vector<Region> regions;
};

/// What a surface has become, and what its observer is told in the end.
struct SurfaceWork {
  Conversion conversion;
  SurfaceRecord record;
};

/// Makes the region of this number into quads, with options whose `progress` counts for the region, for about as much
/// work as its budget has left.
using Work = std::function<kernel::Mesh(std::size_t region, const Options& options, Budget& budget,
                                        ConversionReport& report, Record& record)>;

/// Works on all regions, side by side, each with its share of the surface's budget, and puts the results together, as
/// they were after each stage, too, if the observer wants that.
SurfaceWork work_on_regions(const Surface& surface, const Options& options, Budget& budget, const Work& work);

/// Makes a patch into quads, for about as much work as its budget has left.
using PatchWork = std::function<SurfaceWork(const Patch& patch, const Options& options, Budget& budget)>;

/// `work` on one patch, on the threads that the options allow.
Conversion work_on_patch(const Patch& patch, const Options& options, const PatchWork& work);

/// `work` on each patch, side by side, each with its share of what is allowed for all: what a call may cost, if nothing
/// is said. What some leave is for those that could use much more, which begin again.
std::vector<Outcome> work_on_patches(const std::vector<const Patch*>& patches, const Options& options,
                                     const PatchWork& work, std::optional<double> allowed = {});

/// The work of convert(): layers stay the quads that they are, and the front has what is left.
SurfaceWork convert_patch(const Patch& patch, const Options& options, Budget& budget);

}  // namespace qmorph
