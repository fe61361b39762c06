// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/part_work.hpp"

#include <algorithm>
#include <utility>

#include "engine/convert_region.hpp"
#include "engine/improve_region.hpp"
#include "stretch/convert_stretched.hpp"

namespace qmorph::chart {
namespace {

/// The plane of a chart, in which messages say where a point is in space. Who watches asks for all nodes, most of which
/// are the piece's own.
Plane plane_of(const LaidOut& part, bool is_watched) {
  const Piece& piece = part.piece;
  const Chart& chart = part.chart;
  const auto before = [](const Vec2& a, const Vec2& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); };
  std::vector<std::pair<Vec2, Index>> known;
  for (Index v = 0; is_watched && v < piece.points.size(); ++v) known.emplace_back(chart.flat()[v], v);
  std::sort(known.begin(), known.end(), [&](const auto& a, const auto& b) { return before(a.first, b.first); });
  Plane plane;
  plane.curved = [&piece, &chart, before, known = std::move(known)](const Vec2& p) {
    const auto found = std::lower_bound(known.begin(), known.end(), p,
                                        [&](const auto& a, const Vec2& b) { return before(a.first, b); });
    if (found != known.end() && found->first == p) return piece.points[found->second];
    return chart.to_space(chart.nearest_of_all(p));
  };
  return plane;
}

}  // namespace

PartWork work_on_part(const LaidOut& part, const Ground& ground, const Options& options, Budget& budget, Task task,
                      ConversionReport& report, Record& record, Tries tries) {
  const auto& [piece, chart] = part;
  const Plane plane = plane_of(part, options.observer != nullptr);
  const Region region = piece.region(chart.flat());
  if (task == Task::convert) {
    if (ground.field)
      if (auto quads = stretch::convert_stretched(region, plane, options, budget, report, record))
        return {std::move(quads->mesh), quads->in_chart};
    return {convert_region(region, plane, options, budget, report, record, tries)};
  }
  kernel::Mesh mesh = piece.mesh(chart.flat());
  const kernel::Mesh input = mesh;
  const ImproveStart start = start_improving(region, std::move(mesh), plane, options);
  return {improve_region(start, input, plane, options, budget, report, record)};
}

}  // namespace qmorph::chart
