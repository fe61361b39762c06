// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/gui/document.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <utility>

#include "cli/files/places.hpp"
#include "cli/work/finish_model.hpp"
#include "cli/work/open_input.hpp"
#include "cli/work/write_mesh.hpp"
#include "gmsh/read/meshing.hpp"
#include "gmsh/read/msh/file.hpp"
#include "gmsh/volumes/volumes.hpp"
#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

/// The user's views and others are no part of what the window saves by our button; File > Save of Gmsh has them.
adapter::OpenedModel opened_by_gmsh(const std::string& file) {
  adapter::OpenedModel opened;
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) opened.msh = adapter::read_msh_header(file);
  opened.had_mesh = opened.msh.version != 0 || !adapter::find_meshing_task(false).kept.empty();
  return opened;
}

/// A name for a drawing that no file here has.
std::string unused_script() {
  std::string name = "untitled.geo";
  std::error_code error;
  for (int i = 2; std::filesystem::exists(name, error); ++i) name = fmt::format("untitled-{}.geo", i);
  return (std::filesystem::current_path(error) / name).string();
}

/// Whether writing changes the model.
bool changes_the_model(const Request& request) {
  return request.dimension == 3 || request.order_chosen || request.partitions > 0 || request.orient ||
         !request.consumer.empty();
}

}  // namespace

void Document::open() {
  const Request& request = call_.request;
  if (!request.algorithm_chosen) adapter::set_option("Mesh.Algorithm", adapter::kDefaultAlgorithm);
  if (!request.input.empty()) {
    opened_ = open_as_it_is(call_);
    if (request.drop_volumes) adapter::drop_volumes();
  } else {
    adapter::begin_drawing(unused_script());
  }
  note_state();
  model_ = state_.model, file_ = state_.file;
}

bool Document::reopen() {
  if (!file_.ends_with(".geo")) return false;
  forget();
  meshed_with_.reset();
  opened_ = adapter::open_model(file_, {.no_meshing = true});
  note_state();
  model_ = state_.model, file_ = state_.file;
  return true;
}

bool Document::has_changed_hands() {
  const adapter::LoadedState now = adapter::loaded_state();
  if (now.model == model_ && now.file == file_) return false;
  forget();
  opened_ = opened_by_gmsh(now.file);
  state_ = now, model_ = now.model, file_ = now.file;
  meshed_with_.reset();
  return true;
}

void Document::note_state() {
  state_ = adapter::loaded_state();
  adapter::mesh_has_changed();
}

void Document::forget() {
  triangles_.reset();
  quads_.reset();
  converted_.reset();
  shows_triangles_ = false;
}

/// Meshes what has no mesh; what was meshed here before is meshed anew for another size.
void Document::mesh(double size_factor) {
  adapter::set_option("Mesh.MeshSizeFactor", size_factor);
  if (adapter::loaded_state() != state_) meshed_with_.reset();  // the user has meshed it
  if (meshed_with_ && *meshed_with_ != size_factor) {
    adapter::clear_mesh();
    meshed_with_.reset();
  }
  adapter::MeshingTask task = adapter::find_meshing_task(opened_.msh.version != 0);
  task.compounds = opened_.compounds;
  if (task.is_empty() || call_.request.no_meshing) return;
  const bool all_is_ours = task.kept.empty();
  for (const std::string& warning : adapter::mesh_surfaces(task, call_.request.keep_curves).warnings)
    adapter::log_line(warning, adapter::Severity::warning);
  if (all_is_ours) meshed_with_ = size_factor;
}

const Converted& Document::convert(const Request& request, double size_factor, Options options,
                                   const std::function<void(Options&)>& when_meshed) {
  if (converted_ && !shows_triangles_) back_to_triangles();
  forget();
  mesh(size_factor);
  triangles_ = adapter::take_snapshot();
  const auto start = std::chrono::steady_clock::now();
  Converted result;
  try {
    const adapter::ScopedOption quiet("General.Verbosity", 2);  // we report what there is to report
    if (request.all_quad) result.even = session::make_even(request.surfaces, request.keep_curves);
    when_meshed(options);
    result.model = request.cleanup_only ? session::improve_quads(options, request.surfaces)
                                        : session::recombine(options, request.surfaces);
  } catch (...) {
    if (request.all_quad) adapter::restore(*triangles_);  // curves may have got nodes
    forget();
    note_state();
    throw;
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (meshed_with_) adapter::renumber();
  converted_ = std::move(result);
  note_state();
  return *converted_;
}

bool Document::back_to_triangles() {
  if (!converted_ || shows_triangles_) return false;
  if (adapter::loaded_state() != state_) {  // it would take back what the user has done
    forget();
    return false;
  }
  quads_ = adapter::take_snapshot();
  adapter::restore(*triangles_);
  shows_triangles_ = true;
  note_state();
  return true;
}

bool Document::forward_to_quads() {
  if (!quads_ || !shows_triangles_ || adapter::loaded_state() != state_) return false;
  adapter::restore(*quads_);
  quads_.reset();
  shows_triangles_ = false;
  note_state();
  return true;
}

std::string Document::target(const Request& request) const {
  return adapter::plan_output(request.input.empty() ? file_ : request.input, request.output, request.format).path;
}

std::vector<std::string> Document::save(const Request& of_panel) {
  Request request = of_panel;
  if (request.input.empty()) request.input = file_;
  const adapter::OutputPlan plan = adapter::plan_output(request.input, request.output, request.format);
  const adapter::MshWish wish{request.msh_version, request.binary};
  std::vector<std::string> said = adapter::describe_unwritten(plan, opened_, wish);
  std::optional<adapter::Snapshot> before;
  if (changes_the_model(request)) before = adapter::take_snapshot();
  const Call call{request, call_.arguments, call_.out, call_.err, call_.process};
  adapter::OpenedModel opened = opened_;
  opened.had_mesh = opened.had_mesh || !meshed_with_ || !converted_;
  ModelReport report;
  for (std::string& fault : finish_model(call, opened, session_, report)) said.push_back(std::move(fault));
  prepare_for_readers(call, plan);
  adapter::StagedFile file = adapter::stage(plan, call.names());
  write_mesh(request, plan, opened, /*as_it_was*/ false, file);
  file.commit();
  if (before) adapter::restore(*before);
  note_state();
  said.push_back(fmt::format("{} is written", plan.path));
  return said;
}

}  // namespace qmorph::cli
