// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/work/convert_file.hpp"

#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/files/places.hpp"
#include "cli/files/rule.hpp"
#include "cli/files/scene.hpp"
#include "cli/files/side_files.hpp"
#include "cli/messages/outcome.hpp"
#include "cli/messages/progress.hpp"
#include "cli/process/standard_streams.hpp"
#include "cli/request/engine_options.hpp"
#include "cli/work/finish_model.hpp"
#include "cli/work/open_input.hpp"
#include "cli/work/write_mesh.hpp"
#include "gmsh/read/dialect.hpp"
#include "gmsh/volumes/volumes.hpp"
#include "gmsh/window/window.hpp"
#include "report/stats.hpp"

namespace qmorph::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What is asked for, checked before anything is read, and what has come of it so far.
class Conversion {
 public:
  explicit Conversion(const Call& call)
      : call_(call),
        request_(call.request),
        options_(engine_options(call.request)),
        recorder_(what_to_keep(call.request)),
        plan_(check_places(call.request)) {
    if (what_to_keep(request_).any()) options_.observer = &recorder_;
  }
  int run();

 private:
  void open();
  void see_that_quads_will_be_written();
  void make_quads();
  void see_what_will_be_written();
  int write();
  std::vector<SideFile> side_files(const adapter::StagedFile& mesh, const report::RunFacts& facts) const;
  int status() const {
    return faults_.empty() && model_.count(SurfaceOutcome::left) == 0 ? all_converted : converted_in_part;
  }

  const Call& call_;
  const Request& request_;
  const Clock::time_point start_ = Clock::now();
  Options options_;
  report::Recorder recorder_;
  const adapter::OutputPlan plan_;
  adapter::OpenedModel opened_;
  report::Scene before_;
  std::optional<EvenReport> even_;
  ModelReport model_;
  bool as_it_was_ = false;
  std::vector<std::string> faults_;  ///< of volumes, and of surfaces that the curved edges of a higher order spoil
};

int Conversion::run() {
  const StdoutAsStderr redirected;
  adapter::Session session(request_.gmsh_arguments);
  begin_session(call_, session);
  open();
  see_that_quads_will_be_written();
  make_quads();
  if (model_.surfaces.empty()) {
    call_.err << "qmorph: nothing to convert: " << name_of_input(request_) << " has no surface with elements\n";
    return no_surface;
  }
  see_what_will_be_written();
  for (const SurfaceReport& surface : model_.surfaces)
    if (surface.outcome == SurfaceOutcome::converted && !surface.reason.empty())
      faults_.push_back(fmt::format("surface {}: {}", surface.tag, surface.reason));
  const std::vector<std::string> others = finish_model(call_, opened_, session, model_);
  faults_.insert(faults_.end(), others.begin(), others.end());
  return write();
}

void Conversion::open() {
  call_.begin(cannot_write, fmt::format("cannot write {}: Gmsh crashed", plan_.name));
  adapter::check_format(plan_, call_.names());
  opened_ = open_for_conversion(call_, plan_);
  if (opened_.views.steps.empty() && adapter::has_vtk_data(request_.input))
    call_.warn("data on points and cells is left out: Gmsh reads none from VTK files, but $NodeData from a .msh");
  if (!request_.report.empty()) before_ = read_scene();
}

/// Before there is work.
void Conversion::see_that_quads_will_be_written() {
  if (request_.dimension >= 3) return;  // volumes need all surfaces
  const adapter::MshWish wish{request_.msh_version, request_.binary};
  if (adapter::only_volumes_are_grouped(plan_, opened_, wish)) {
    call_.warn("only volumes are in physical groups: all elements are written, as with -setnumber Mesh.SaveAll 1");
    adapter::set_option("Mesh.SaveAll", 1);
  }
  if (adapter::leaves_out_every_surface(plan_, opened_, wish)) throw no_quad_written(plan_.name);
}

void Conversion::make_quads() {
  std::optional<ProgressBar> bar;
  if (request_.verbosity >= 1 && call_.process.err_is_terminal) options_.progress = std::ref(bar.emplace(call_.err));
  if (request_.all_quad) even_ = session::make_even(request_.surfaces, request_.keep_curves);
  model_ = request_.cleanup_only ? session::improve_quads(options_, request_.surfaces)
                                 : session::recombine(options_, request_.surfaces);
  options_.progress = nullptr;
}

/// Warns of what will not be.
void Conversion::see_what_will_be_written() {
  const adapter::MshWish wish{request_.msh_version, request_.binary};
  const std::vector<std::string> unwritten = adapter::describe_unwritten(plan_, opened_, wish);
  // Volumes need all surfaces.
  if (request_.dimension < 3) keep_written(adapter::find_unwritten_surfaces(plan_, opened_, wish), plan_.name, model_);
  as_it_was_ = is_as_it_was(request_, plan_, opened_, model_);
  if (as_it_was_) return even_.reset();  // OUT has the curves of IN
  for (const std::string& lost : unwritten) call_.warn(lost);
}

int Conversion::write() {
  const Clock::time_point write_start = Clock::now();
  call_.begin(cannot_write, fmt::format("cannot write {}: Gmsh crashed", plan_.name));
  if (!as_it_was_) prepare_for_readers(call_, plan_);
  adapter::StagedFile mesh = adapter::stage(plan_, call_.names());
  call_.err.call(mesh.path(), plan_.name);
  const bool written = write_mesh(request_, plan_, opened_, as_it_was_, mesh);
  report::RunFacts facts{request_.from_stdin ? "-" : request_.input, request_.to_stdout ? "-" : plan_.path,
                         call_.arguments, status(), even_};
  facts.volumes = adapter::count_volume_elements();
  facts.division = opened_.division;
  facts.mended = opened_.even;
  facts.open_seconds = opened_.open_seconds;
  facts.mesh_seconds = opened_.mesh_seconds;
  facts.write_seconds = seconds_since(write_start);
  facts.total_seconds = seconds_since(start_);
  put_in_place(written ? &mesh : nullptr, side_files(mesh, facts), call_.names());
  print_summary(request_, opened_, model_, facts, plan_.name, call_.err);
  for (const std::string& what : faults_) call_.err << "qmorph: " << what << '\n';
  if (request_.view)
    if (const std::string problem = adapter::show_in_window(plan_.path); !problem.empty())
      call_.err << "qmorph: --view: " << problem << '\n';
  return facts.exit_status;
}

std::vector<SideFile> Conversion::side_files(const adapter::StagedFile& mesh, const report::RunFacts& facts) const {
  std::vector<SideFile> files = make_side_files(request_, before_, model_, recorder_, facts);
  if (!request_.depfile.empty()) files.push_back({request_.depfile, rule_for_make(request_, opened_, plan_)});
  if (!request_.views) return files;
  std::vector<SideFile> views = write_views(request_, opened_, plan_.path, mesh);
  if (request_.to_stdout && !views.empty())
    throw UsageError("--views: the standard output has no file beside it; write MSH 4, or give -o a name");
  std::move(views.begin(), views.end(), std::back_inserter(files));
  return files;
}

}  // namespace

int convert_file(const Call& call) { return Conversion(call).run(); }

}  // namespace qmorph::cli
