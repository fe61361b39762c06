// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/part_work.hpp"

#include <algorithm>
#include <numeric>

#include "engine/allowance.hpp"
#include "engine/convert_region.hpp"
#include "engine/improve_region.hpp"
#include "engine/pipeline.hpp"

namespace qmorph::chart {
namespace {

/// The plane of a chart, in which messages say where a point is in space.
Plane plane_of(const Chart& chart) {
  Plane plane;
  plane.curved = [&chart](const Vec2& p) { return chart.to_space(chart.nearest_of_all(p)); };
  return plane;
}

std::size_t count_bad(const kernel::Mesh& mesh) {
  std::size_t bad = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f) bad += mesh.is_live_face(f) && !mesh.is_valid_face(f);
  return bad;
}

}  // namespace

kernel::Mesh work_on_part(const LaidOut& part, const Options& options, double allowed, Task task, ConversionReport& report,
                          Record& record) {
  const auto& [piece, chart] = part;
  const Plane plane = plane_of(chart);
  const Region region = piece.region(chart.flat());
  if (task == Task::convert) return qmorph::convert_region(region, plane, options, allowed, report, record);
  kernel::Mesh mesh = piece.mesh(chart.flat());
  const kernel::Mesh input = mesh;
  const ImproveStart start = start_improving(region, std::move(mesh), plane, options);
  return improve_region(start, input, plane, options, allowed, report, record);
}

std::optional<Reworked> clean_window(const LaidOut& window, const Options& options,
                                     const space::Background& background) {
  const auto& [piece, chart] = window;
  Reworked work{&piece, piece.mesh(chart.flat()), {}};
  const std::size_t bad = count_bad(work.mesh);
  std::vector<Index> nodes(piece.points.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  Options own = options;
  own.observer = nullptr;
  own.progress = {};
  ConversionReport report;
  Record record;
  Pipeline pipeline(own, report, record, work.mesh, allowance(double(work.mesh.face_slots())));
  pipeline.clean_near(work.mesh, nodes);
  pipeline.polish(work.mesh);
  if (count_bad(work.mesh) > bad || folds_onto_itself(work.mesh, piece)) return {};
  work.lifted = lift(work.mesh, piece, chart, background);
  return work;
}

}  // namespace qmorph::chart
