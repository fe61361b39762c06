// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/convert_region.hpp"

#include <numeric>

#include "chart/curved_region.hpp"
#include "chart/rework.hpp"
#include "qmorph/error.hpp"

namespace qmorph::chart {
namespace {

/// The plane of a chart, in which messages say where a point is in space.
Plane plane_of(const Chart& chart) {
  Plane plane;
  plane.curved = [&chart](const Vec2& p) { return chart.to_space(chart.nearest_of_all(p)); };
  return plane;
}

}  // namespace

SurfaceMesh convert_region(const CurvedRegion& region, const Options& options, ConversionStats& stats) {
  const SurfaceMesh start = region.start();
  std::vector<Index> all(start.faces.size());
  std::iota(all.begin(), all.end(), 0);
  const Piece piece(start, opposite_sides(start), {}, all);
  const Chart chart(piece);
  if (getenv("CHART_DEBUG"))
    fprintf(stderr, "region %zu triangles, sides %zu: distortion %.3f scaling %.3f flipped %zu\n", all.size(),
            piece.boundary_sides, chart.flattening().distortion, chart.flattening().scaling,
            chart.flattening().flipped);
  if (!chart.is_good()) throw SurfaceError("it is curved too much near " + describe(region.points[0]));
  Options own = options;
  own.measure_stages = own.record_film = false;
  const Plane plane = plane_of(chart);
  Reworked work{&piece, qmorph::convert_region(piece.region(chart.flat()), plane, own, stats, nullptr), {}};
  work.lifted = lift(work.mesh, piece, chart, *region.background);
  return replace(start, {work});
}

}  // namespace qmorph::chart
