// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parts/convert_parts.hpp"

#include "engine/parts/divide.hpp"
#include "engine/parts/grid_outline.hpp"
#include "engine/parts/join.hpp"
#include "parallel/for_each.hpp"
#include "parallel/shared_progress.hpp"

namespace qmorph {
namespace {

/// What one part becomes.
struct PartResult {
  std::vector<Index> node;  ///< as Region::node of the part
  PartElements elements;
  ConversionReport report;
  Record record;
  std::size_t cost = 0;
};

PartResult work_on_part(Region part, const Plane& plane, const Options& options, double allowed) {
  PartResult result;
  kernel::Mesh mesh(part.points, part.triangles, part.open);
  for (Index v : part.fixed) mesh.set_fixed(v);
  result.node = std::move(part.node);
  part = {};
  Pipeline pipeline(options, result.report, result.record, mesh, allowed);
  pipeline.advance_front(mesh, plane);
  pipeline.clean(mesh);
  result.elements = PartElements(result.node, mesh);
  result.cost = mesh.work();
  return result;
}

std::vector<PartResult> work_on_parts(std::vector<Region> parts, const Plane& plane, const Options& options,
                                      double allowed) {
  std::vector<PartResult> results(parts.size());
  std::size_t triangles = 0;
  for (const Region& part : parts) triangles += part.triangles.size();
  const parallel::SharedProgress shared(options.progress, double(triangles));
  std::vector<ProgressCallback> progress;
  for (const Region& part : parts) progress.push_back(shared.part(double(part.triangles.size())));
  parallel::for_each_index(parts.size(), [&](std::size_t i) {
    if (shared.is_over()) return;
    Options own = options;
    own.progress = progress[i];
    const double share = double(parts[i].triangles.size()) / double(triangles);
    results[i] = work_on_part(std::move(parts[i]), plane, own, allowed * share);
  });
  shared.finish();
  return results;
}

kernel::Mesh join_stage(const Whole& whole, const std::vector<PartResult>& results, Stage stage) {
  std::vector<PartElements> elements;
  for (const PartResult& result : results)
    elements.emplace_back(result.node, *result.record.stages[std::size_t(stage)]);
  return join(whole, std::move(elements));
}

}  // namespace

bool is_large(std::size_t triangles, const Options& options) {
  return options.part_triangles != 0 && 2 * triangles >= 3 * options.part_triangles;
}

std::optional<kernel::Mesh> convert_in_parts(kernel::Mesh start, const kernel::Mesh& input, const Plane& plane,
                                             const Options& options, double allowed, ConversionReport& report,
                                             Record& record) {
  if (has_grid_outline(start)) return {};  // cleanup will find the grid, but only in one piece
  const Division division = divide(start, options.part_triangles);
  if (division.parts < 2) return {};
  std::vector<Region> parts = take_apart(start, division);
  Whole whole(start, division);
  start = {};

  std::vector<PartResult> results = work_on_parts(std::move(parts), plane, options, allowed);
  std::vector<PartElements> elements;
  for (PartResult& result : results) {
    report.add(result.report);
    record.add(result.record);
    elements.push_back(std::move(result.elements));
  }
  if (wants_stages(options))
    for (Stage stage : {Stage::front, Stage::elimination, Stage::smoothing})
      record.stages[std::size_t(stage)] = join_stage(whole, results, stage);
  kernel::Mesh mesh = join(std::move(whole), std::move(elements));
  for (const PartResult& result : results) mesh.add_work(result.cost);

  Pipeline pipeline(options, report, record, input, allowed);
  pipeline.clean_near(mesh, division.interface);
  pipeline.polish(mesh);
  if (!plane.curved) pipeline.open_tips(mesh);
  return mesh;
}

}  // namespace qmorph
