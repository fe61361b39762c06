// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A region of a curved surface, and what it becomes.

#include <memory>

#include "chart/surface_mesh.hpp"
#include "qmorph/options.hpp"
#include "qmorph/report.hpp"

namespace qmorph::chart {

struct CurvedRegion {
  /// As cut_into_regions() makes it; its plane points say nothing.
  Region region;
  std::vector<Eigen::Vector3d> points;
  std::vector<space::Background::Edge> barriers;
  std::unique_ptr<const space::Background> background;
  std::vector<std::pair<Index, Index>> creases;  ///< edges, lower vertex first, sorted

  CurvedRegion(const Patch& patch, Region cut, double crease_angle);
  /// Its triangles, before anything is done to them.
  SurfaceMesh start() const;
};

/// The regions of a patch.
std::vector<CurvedRegion> curved_regions(const Patch& patch, double crease_angle);

/// Quads of a region. Vertices of the region keep their numbers.
/// \throws SurfaceError
SurfaceMesh convert_region(const CurvedRegion& region, const Options& options, ConversionReport& report);

}  // namespace qmorph::chart
