// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/part_work.hpp"

#include "engine/convert_region.hpp"
#include "engine/improve_region.hpp"

namespace qmorph::chart {
namespace {

/// The plane of a chart, in which messages say where a point is in space.
Plane plane_of(const Chart& chart) {
  Plane plane;
  plane.curved = [&chart](const Vec2& p) { return chart.to_space(chart.nearest_of_all(p)); };
  return plane;
}

}  // namespace

kernel::Mesh work_on_part(const LaidOut& part, const Options& options, double allowed, Task task,
                          ConversionReport& report, Record& record) {
  const auto& [piece, chart] = part;
  const Plane plane = plane_of(chart);
  const Region region = piece.region(chart.flat());
  if (task == Task::convert) return qmorph::convert_region(region, plane, options, allowed, report, record);
  kernel::Mesh mesh = piece.mesh(chart.flat());
  const kernel::Mesh input = mesh;
  const ImproveStart start = start_improving(region, std::move(mesh), plane, options);
  return improve_region(start, input, plane, options, allowed, report, record);
}

}  // namespace qmorph::chart
