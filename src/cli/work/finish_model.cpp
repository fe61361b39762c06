// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/work/finish_model.hpp"

#include <utility>

#include "gmsh/read/meshing.hpp"
#include "gmsh/read/raise.hpp"
#include "gmsh/volumes/volumes.hpp"
#include "gmsh/write/consumers.hpp"
#include "gmsh/write/prepare.hpp"

namespace qmorph::cli {

std::vector<std::string> finish_model(const Call& call, adapter::OpenedModel& opened, adapter::Session& session,
                                      ModelReport& model) {
  const Request& request = call.request;
  adapter::MeshedVolumes volumes;
  const auto note = [&](const std::vector<std::string>& warnings) {
    opened.warnings.insert(opened.warnings.end(), warnings.begin(), warnings.end());
  };
  try {
    if (request.dimension == 3) volumes = adapter::mesh_volumes(opened.had_mesh);
  } catch (const adapter::BrokenModel&) {
    session.leave();
    throw;
  }
  note(volumes.warnings);
  for (const std::string& what : volumes.told) call.warn(what);
  const adapter::RaisedModel raised = adapter::raise_model();
  note(raised.warnings);
  model.on_geometry.moved_sides += raised.moved_sides;
  if (!opened.had_mesh) adapter::renumber();
  if (request.partitions > 0) {
    opened.carried = adapter::carry_over(opened.views);  // partitions take the elements from their surfaces
    adapter::partition(request.partitions);
  }
  std::vector<std::string> faults = std::move(volumes.bad);
  faults.insert(faults.end(), raised.bent.begin(), raised.bent.end());
  return faults;
}

void prepare_for_readers(const Call& call, const adapter::OutputPlan& plan) {
  const Request& request = call.request;
  const adapter::Consumer* reader = request.consumer.empty() ? nullptr : &adapter::find_consumer(request.consumer);
  if (request.orient || (reader && reader->oriented))
    if (const std::string problem = adapter::orient_surfaces(); !problem.empty()) call.warn(problem);
  if (reader && reader->wants_incomplete) adapter::drop_middle_nodes();
  if (!reader) adapter::prepare_for_format(plan);
}

}  // namespace qmorph::cli
