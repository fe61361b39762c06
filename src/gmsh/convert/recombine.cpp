// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "gmsh/convert/classified.hpp"
#include "gmsh/convert/jobs.hpp"
#include "gmsh/convert/run.hpp"
#include "gmsh/convert/stop_watch.hpp"
#include "gmsh/convert/whole_surface.hpp"
#include "gmsh/model/chosen.hpp"
#include "gmsh/model/patches.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph {
namespace {

using namespace adapter;

/// Indices of the surfaces to look at, by tag.
std::vector<std::uint32_t> select_surfaces(const ModelMesh& mesh, const std::vector<int>& wanted) {
  std::vector<std::uint32_t> selected = choose_surfaces(mesh, wanted);
  std::erase_if(selected, [&](std::uint32_t e) { return mesh.entities[e].element_count() == 0; });
  return selected;
}

ModelReport run(Task task, const std::vector<int>& surfaces, const Options& options,
                const std::map<int, Patch>& before = {}) {
  ModelReport report;
  const QuietErrors quiet;
  StopWatch watch;
  Run run(task, options, report, before);
  report.read_seconds += watch.lap();
  run.visit(select_surfaces(run.mesh(), surfaces));
  run.finish();
  return report;
}

}  // namespace

std::array<std::size_t, kPoorReasons> ModelReport::count_poor() const {
  std::array<std::size_t, kPoorReasons> counts{};
  for (const SurfaceReport& surface : surfaces)
    for (const PoorQuad& poor : surface.poor) ++counts[std::size_t(poor.reason)];
  return counts;
}

std::size_t ModelReport::count(SurfaceOutcome outcome) const {
  return static_cast<std::size_t>(std::count_if(surfaces.begin(), surfaces.end(),
                                                [outcome](const SurfaceReport& s) { return s.outcome == outcome; }));
}

ModelReport session::recombine(const Options& options, const std::vector<int>& surfaces) {
  return run(Task::convert, surfaces, options);
}

ModelReport session::improve_quads(const Options& options, const std::vector<int>& surfaces) {
  return run(Task::improve, surfaces, options);
}

ModelReport session::measure_surfaces(const std::vector<int>& surfaces, const std::map<int, Patch>& before) {
  return run(Task::measure, surfaces, {}, before);
}

std::map<int, Patch> session::read_surfaces(const std::vector<int>& surfaces) {
  std::vector<std::string> warnings;
  const QuietErrors quiet;
  const ClassifiedMesh model = read_classified_mesh(warnings);
  const FixedEdges fixed_edges(model.mesh, model.use);
  std::vector<Index> local(model.mesh.tags.size(), kNone);
  std::map<int, Patch> patches;
  for (std::uint32_t entity : select_surfaces(model.mesh, surfaces)) {
    try {
      const SurfaceMesh surface = read_surface(model.mesh, model.use, fixed_edges, entity, local);
      patches[model.mesh.entities[entity].tag] = whole_surface(surface);
    } catch (const SurfaceError&) {
      continue;  // nothing to measure by
    }
  }
  return patches;
}

}  // namespace qmorph
