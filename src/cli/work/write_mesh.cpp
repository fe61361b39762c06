// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/work/write_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/files/places.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/write/consumers.hpp"

namespace qmorph::cli {
namespace {

/// In the reader's terms. \throws ReaderError
void write_for_consumer(const Request& request, const adapter::OpenedModel& opened, adapter::StagedFile& file) {
  const adapter::Consumer& consumer = adapter::find_consumer(request.consumer);
  const bool everything = opened.msh.version != 0 || adapter::get_option("Mesh.SaveAll") != 0;
  adapter::ConsumerMesh mesh = adapter::collect_for(consumer, everything);
  const std::string family = consumer.format == "inp" ? adapter::choose_family(request.elements, mesh) : std::string();
  if (!mesh.complaints.empty()) throw ReaderError{mesh.complaints};
  if (consumer.format == "inp")
    adapter::write_inp_for(mesh, family, file.path());
  else if (consumer.format == "msh2")
    adapter::write_msh2_for(consumer, mesh, file.path());
  else
    adapter::write_su2_for(mesh, file.path());
}

}  // namespace

bool is_as_it_was(const Request& request, const adapter::OutputPlan& plan, const adapter::OpenedModel& opened,
                  const ModelReport& model) {
  const bool same_format = opened.msh.version != 0 && plan.format.is_msh && plan.format.msh_version == 0 &&
                           !request.msh_version && !request.binary && request.merged.empty() && !request.views;
  const bool untouched = model.count(SurfaceOutcome::converted) == 0 && request.dimension != 3 &&
                         !request.drop_volumes && !request.order_chosen && !request.orient && request.partitions == 0;
  return same_format && untouched;
}

InputError no_quad_written(const std::string& output) {
  return InputError(
      fmt::format("no surface is in a physical group, and there are groups: {} would have no quad; add Physical "
                  "Surface, or -setnumber Mesh.SaveAll 1",
                  output));
}

void keep_written(const std::vector<int>& unwritten, const std::string& output, ModelReport& model) {
  const auto is_unwritten = [&](const SurfaceReport& surface) {
    return std::count(unwritten.begin(), unwritten.end(), surface.tag) > 0;
  };
  if (std::erase_if(model.surfaces, is_unwritten) == 0) return;
  if (model.surfaces.empty()) throw no_quad_written(output);
  std::vector<int> measured;
  for (const SurfaceReport& surface : model.surfaces)
    if (surface.outcome != SurfaceOutcome::left) measured.push_back(surface.tag);
  model.total = measured.empty() ? Quality() : session::measure_surfaces(measured).total;
}

bool write_mesh(const Request& request, const adapter::OutputPlan& plan, const adapter::OpenedModel& opened,
                bool as_it_was, adapter::StagedFile& file) {
  if (!request.consumer.empty()) {
    write_for_consumer(request, opened, file);
  } else if (!as_it_was) {
    adapter::write_model(plan, opened, {request.msh_version, request.binary}, file);
  } else {
    if (is_same_file(request.input, plan.path)) return false;
    adapter::copy_input(request.input, plan, file);
  }
  return true;
}

}  // namespace qmorph::cli
