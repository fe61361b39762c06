#include "cli/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <exception>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "cli/check.hpp"
#include "cli/error_stream.hpp"
#include "cli/outcome.hpp"
#include "cli/places.hpp"
#include "cli/progress.hpp"
#include "cli/reading_limits.hpp"
#include "cli/request.hpp"
#include "cli/scene.hpp"
#include "cli/side_files.hpp"
#include "cli/slate.hpp"
#include "cli/standard_input.hpp"
#include "cli/standard_streams.hpp"
#include "gmsh/read/meshing.hpp"
#include "gmsh/read/open.hpp"
#include "gmsh/read/readable.hpp"
#include "gmsh/read/sources.hpp"
#include "gmsh/session/scratch_file.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/window/window.hpp"
#include "gmsh/write/consumers.hpp"
#include "gmsh/write/prepare.hpp"
#include "gmsh/write/staged_file.hpp"
#include "gmsh/write/write.hpp"
#include "qmorph/gmsh.hpp"
#include "report/stats.hpp"
#include "report/summary.hpp"
#include "report/version.hpp"

namespace qmorph::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// What a reader would not take, and why.
struct ReaderError {
  std::vector<std::string> complaints;
};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

int status_of(const ModelReport& model) {
  return model.count(SurfaceOutcome::left) ? converted_in_part : all_converted;
}

/// Nothing has changed: the output is to be the input, byte for byte.
bool is_as_it_was(const Request& request, const adapter::OutputPlan& plan, const adapter::OpenedModel& opened,
                  const ModelReport& model) {
  const bool same_format = opened.msh.version != 0 && plan.format.is_msh && plan.format.msh_version == 0 &&
                           !request.msh_version && !request.binary && request.merged.empty() && !request.views;
  const bool untouched = model.count(SurfaceOutcome::converted) == 0 && request.dimension != 3 &&
                         !request.drop_volumes && !request.order_chosen && !request.orient && request.partitions == 0;
  return same_format && untouched;
}

/// In the reader's terms. \throws ReaderError
void write_for_consumer(const Request& request, const adapter::OpenedModel& opened, adapter::StagedFile& file) {
  const adapter::Consumer& consumer = adapter::find_consumer(request.consumer);
  const bool everything = opened.msh.version != 0 || adapter::get_option("Mesh.SaveAll") != 0;
  const adapter::ConsumerMesh mesh = adapter::collect_for(consumer, everything);
  if (!mesh.complaints.empty()) throw ReaderError{mesh.complaints};
  if (consumer.format == "inp")
    adapter::write_inp_for(mesh, request.elements, file.path());
  else if (consumer.format == "msh2")
    adapter::write_msh2_for(consumer, mesh, file.path());
  else
    adapter::write_su2_for(mesh, file.path());
}

/// Writes the mesh to a file beside its place. \return false if the output is the input and stays what it is
bool write(const Request& request, const adapter::OutputPlan& plan, const adapter::OpenedModel& opened,
           const ModelReport& model, adapter::StagedFile& file) {
  if (!request.consumer.empty()) {
    write_for_consumer(request, opened, file);
  } else if (!is_as_it_was(request, plan, opened, model)) {
    adapter::write_model(plan, opened, {request.msh_version, request.binary}, file);
  } else {
    if (is_same_file(request.input, plan.path)) return false;
    adapter::copy_input(request.input, plan, file);
  }
  return true;
}

/// Takes out of the figures what will not be in the file. \throws InputError if nothing is left
void keep_written(const std::vector<int>& unwritten, const std::string& output, ModelReport& model) {
  const auto is_unwritten = [&](const SurfaceReport& surface) {
    return std::count(unwritten.begin(), unwritten.end(), surface.tag) > 0;
  };
  if (std::erase_if(model.surfaces, is_unwritten) == 0) return;
  if (model.surfaces.empty())
    throw InputError(
        fmt::format("no surface is in a physical group, and there are groups: {} would have no quad; add Physical "
                    "Surface, or -setnumber Mesh.SaveAll 1",
                    output));
  std::vector<int> measured;
  for (const SurfaceReport& surface : model.surfaces)
    if (surface.outcome != SurfaceOutcome::left) measured.push_back(surface.tag);
  model.total = measured.empty() ? Quality() : session::measure_surfaces(measured).total;
}

/// The mesh and all the other files, or none. \param mesh null if it is in its place already
void commit(adapter::StagedFile* mesh, const std::vector<SideFile>& others, adapter::TemporaryNames* names) {
  std::deque<adapter::StagedFile> staged;
  for (const SideFile& other : others) {
    staged.emplace_back(other.path, std::string(), names).write_text(other.text);
    staged.back().prepare();
  }
  if (mesh) mesh->commit();
  for (adapter::StagedFile& file : staged) file.commit();
}

/// The options of the engine that --smoothing and --set name.
Options engine_options(const Request& request) {
  Options options;
  options.threads = request.threads;
  options.layers = request.layers == "on";
  if (request.smoothing == "thesis")
    options.smoothing.method = SmoothingMethod::thesis;
  else if (!request.smoothing.empty() && request.smoothing != "shape_energy")
    throw UsageError(fmt::format("--smoothing: '{}' is neither shape_energy nor thesis", request.smoothing));
  for (const std::string& setting : request.settings) {
    const std::size_t equals = setting.find('=');
    const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (value.empty() || *end) throw UsageError(fmt::format("--set {}: it takes NAME=NUMBER", setting));
    set_option(options, setting.substr(0, equals), number);
  }
  return options;
}

/// What comes after the quads: volumes on them, the order of all elements, partitions.
/// \return what is not as it should be
std::vector<std::string> finish_model(const Request& request, adapter::OpenedModel& opened, adapter::Session& session) {
  const auto note = [&](const std::vector<std::string>& warnings) {
    opened.warnings.insert(opened.warnings.end(), warnings.begin(), warnings.end());
  };
  try {
    if (request.dimension == 3) note(adapter::mesh_volumes(opened.had_mesh));
  } catch (const adapter::BrokenModel&) {
    session.leave();
    throw;
  }
  const adapter::RaisedModel raised = adapter::raise_model();
  note(raised.warnings);
  if (!opened.had_mesh) adapter::renumber();
  if (request.partitions > 0) {
    opened.carried = adapter::carry_over(opened.views);  // partitions take the elements from their surfaces
    adapter::partition(request.partitions);
  }
  return raised.bent;
}

/// Changes of the model that the reader, or the readers of the format, ask for.
void prepare_for_readers(const Request& request, const adapter::OutputPlan& plan, std::ostream& err) {
  const adapter::Consumer* reader = request.consumer.empty() ? nullptr : &adapter::find_consumer(request.consumer);
  if (request.orient || (reader && reader->oriented))
    if (const std::string problem = adapter::orient_surfaces(); !problem.empty() && request.verbosity >= 1)
      err << "warning: " << problem << '\n';
  if (reader && reader->wants_incomplete) adapter::drop_middle_nodes();
  if (!reader) adapter::prepare_for_format(plan);
}

/// What the result depends on: what Gmsh has read, and what it was told to read.
std::string make_rule(const Request& request, const adapter::OpenedModel& opened, const adapter::OutputPlan& plan) {
  std::vector<std::string> files{request.input};
  files.insert(files.end(), request.merged.begin(), request.merged.end());
  if (!request.background.empty()) files.push_back(request.background);
  files.insert(files.end(), request.option_files.begin(), request.option_files.end());
  files.push_back(request.input + ".opt");  // Gmsh takes it by itself
  files.insert(files.end(), opened.sources.begin(), opened.sources.end());
  return adapter::make_rule(plan.path, adapter::with_named_files(files));
}

/// One call of the command, as it goes through the functions below.
struct Call {
  const Request& request;
  const std::vector<std::string>& arguments;
  std::ostream& out;
  ErrorStream& err;
  const Process& process;

  /// What to say if this process dies from here on.
  void begin(ExitStatus status, const std::string& trouble) const {
    if (process.slate) process.slate->begin(status, trouble);
  }
  adapter::TemporaryNames* names() const { return process.slate ? &process.slate->files : nullptr; }
};

/// Opens the input and what is merged with it, and meshes it.
adapter::OpenedModel open_input(const Call& call, adapter::OpenOptions options) {
  const std::string name = name_of_input(call.request);
  std::optional<ReadingLimits> limits;
  std::vector<std::string> files = options.merged;
  files.push_back(call.request.input);
  if (call.process.slate) limits.emplace(files);
  call.begin(bad_input, name + " cannot be read: Gmsh crashed");
  options.when_read = [&] {
    limits.reset();
    call.begin(bad_input, name + " cannot be meshed: Gmsh crashed");
  };
  adapter::OpenedModel opened = adapter::open_model(call.request.input, options);
  call.begin(bad_input, "a crash while qmorph worked on " + name);
  return opened;
}

adapter::OpenedModel open(const Call& call, const adapter::OutputPlan& plan) {
  const Request& request = call.request;
  if (!request.algorithm_chosen) adapter::set_option("Mesh.Algorithm", adapter::kDefaultAlgorithm);
  if (plan.format.quad_nodes == 8) adapter::set_option("Mesh.SecondOrderIncomplete", 1);
  for (const std::string& name : request.option_names)
    if (!adapter::option_exists(name) && request.verbosity >= 1)
      call.err << "warning: this Gmsh has no option " << name << '\n';
  adapter::OpenedModel opened = open_input(call, {.merged = request.merged,
                                                  .background = request.background,
                                                  .no_meshing = request.no_meshing,
                                                  .ignore_periodicity = request.ignore_periodicity});
  if (request.drop_volumes) adapter::drop_volumes();
  if (request.verbosity >= 1) name_ignored_options(request, opened, call.err);
  if (request.order_chosen) adapter::lower_model(static_cast<int>(adapter::get_option("Mesh.ElementOrder")));
  if (request.consumer.empty()) {
    const int raised = static_cast<int>(adapter::get_option("Mesh.ElementOrder")), has = adapter::order_of_surfaces();
    adapter::check_elements(plan, has > 1 ? has : raised);
  }
  return opened;
}

/// The surfaces of the file that the mesh is measured against.
std::map<int, Patch> read_reference(const Request& request) {
  if (request.against.empty()) return {};
  adapter::check_readable(request.against);
  const adapter::Session session(request.gmsh_arguments);
  adapter::open_model(request.against, {.no_meshing = true, .ignore_periodicity = request.ignore_periodicity});
  std::map<int, Patch> surfaces = session::read_surfaces();
  if (surfaces.empty()) throw InputError(fmt::format("--against {}: it has no mesh of surfaces to measure by", request.against));
  return surfaces;
}

int check_file(const Call& call) {
  const Request& request = call.request;
  adapter::check_readable(request.input);
  ModelReport model;
  {
    const StdoutAsStderr redirected;
    const std::map<int, Patch> before = read_reference(request);
    adapter::Session session(request.gmsh_arguments);
    if (call.process.slate) session.leave();
    open_input(call, {.merged = request.merged, .no_meshing = true, .ignore_periodicity = request.ignore_periodicity});
    model = session::measure_surfaces(request.surfaces, before);
  }
  if (model.surfaces.empty()) throw InputError(fmt::format("{} has no surface with elements", request.input));
  if (request.verbosity >= 1) answer(report::check_line(model) + '\n', call.out);
  const std::vector<std::string> reasons = find_reasons(model, request.thresholds);
  for (const std::string& reason : reasons) call.err << "qmorph: " << reason << '\n';
  return reasons.empty() ? all_converted : not_good_enough;
}

int convert_file(const Call& call) {
  const Request& request = call.request;
  const Clock::time_point start = Clock::now();
  Options options = engine_options(request);
  const report::Wishes wishes = what_to_keep(request);
  report::Recorder recorder(wishes);
  if (wishes.any()) options.observer = &recorder;
  const adapter::OutputPlan plan = check_places(request);
  const StdoutAsStderr redirected;
  adapter::Session session(request.gmsh_arguments);
  if (call.process.slate) session.leave();
  const std::string writing = fmt::format("cannot write {}: Gmsh crashed", plan.name);
  call.begin(cannot_write, writing);
  adapter::check_format(plan, call.names());
  adapter::OpenedModel opened = open(call, plan);

  std::optional<ProgressBar> bar;
  if (request.verbosity >= 1 && call.process.err_is_terminal) options.progress = std::ref(bar.emplace(call.err));
  const report::Scene before = request.report.empty() ? report::Scene{} : read_scene();
  std::optional<EvenReport> even;
  if (request.all_quad) even = session::make_even(request.surfaces, request.keep_curves);
  ModelReport model = request.cleanup_only ? session::improve_quads(options, request.surfaces)
                                           : session::recombine(options, request.surfaces);
  bar.reset();
  if (model.surfaces.empty()) {
    call.err << "qmorph: nothing to convert: " << name_of_input(request) << " has no surface with elements\n";
    return no_surface;
  }
  const adapter::MshWish wish{request.msh_version, request.binary};
  const std::vector<std::string> unwritten = adapter::describe_unwritten(plan, opened, wish);
  // Volumes stand on all surfaces.
  if (request.dimension < 3) keep_written(adapter::find_unwritten_surfaces(plan, opened, wish), plan.name, model);

  const std::vector<std::string> bent = finish_model(request, opened, session);
  if (is_as_it_was(request, plan, opened, model)) even.reset();  // OUT has the curves of IN

  const Clock::time_point write_start = Clock::now();
  if (request.verbosity >= 1 && !is_as_it_was(request, plan, opened, model))
    for (const std::string& lost : unwritten) call.err << "warning: " << lost << '\n';
  call.begin(cannot_write, writing);
  if (!is_as_it_was(request, plan, opened, model)) prepare_for_readers(request, plan, call.err);
  adapter::StagedFile file = adapter::stage(plan, call.names());
  call.err.call(file.path(), plan.name);
  const bool written = write(request, plan, opened, model, file);
  const int status = bent.empty() ? status_of(model) : converted_in_part;
  report::RunFacts facts{request.from_stdin ? "-" : request.input, request.to_stdout ? "-" : plan.path,
                         call.arguments, status, even};
  facts.open_seconds = opened.open_seconds;
  facts.mesh_seconds = opened.mesh_seconds;
  facts.write_seconds = seconds_since(write_start);
  facts.total_seconds = seconds_since(start);
  std::vector<SideFile> others = make_side_files(request, before, model, recorder, facts);
  if (!request.depfile.empty()) others.push_back({request.depfile, make_rule(request, opened, plan)});
  if (request.views) {
    std::vector<SideFile> views = write_views(request, opened, plan.path, file);
    if (request.to_stdout && !views.empty())
      throw UsageError("--views: the standard output has no file beside it; write MSH 4, or give -o a name");
    std::move(views.begin(), views.end(), std::back_inserter(others));
  }
  commit(written ? &file : nullptr, others, call.names());
  print_summary(request, opened, model, facts, plan.name, call.err);
  for (const std::string& what : bent) call.err << "qmorph: " << what << '\n';
  if (request.view)
    if (const std::string problem = adapter::show_in_window(plan.path); !problem.empty())
      call.err << "qmorph: --view: " << problem << '\n';
  return facts.exit_status;
}

/// Standard input and output have names as files for as long as it takes.
int run_with_streams(Request request, const std::vector<std::string>& arguments, std::ostream& out, ErrorStream& err,
                     const Process& process) {
  std::unique_ptr<adapter::ScratchFile> input;
  std::optional<adapter::ScratchFile> output;
  request.from_stdin = request.input == "-";
  request.to_stdout = request.output == "-" || (request.output.empty() && request.from_stdin);
  if (request.from_stdin) {
    input = read_standard_input(std::cin);
    request.input = input->path();
    err.call(request.input, "standard input");
  }
  const Call call{request, arguments, out, err, process};
  if (request.check) return check_file(call);
  if (!request.to_stdout) return convert_file(call);
  output.emplace(".msh");
  request.output = output->path();
  err.call(request.output, "standard output");
  if (request.format.empty() && request.consumer.empty()) request.format = "msh";
  const int status = convert_file(call);
  answer_with_file(output->path(), out);
  return status;
}

int fail(int status, std::string_view what, std::ostream& err) {
  err << "qmorph: " << what << (status == bad_usage ? " (see qmorph --help)" : "") << '\n';
  return status;
}

/// \throws what run() turns into an exit status
int run_request(const std::vector<std::string>& arguments, std::ostream& out, ErrorStream& err,
                const Process& process) {
  const Request request = parse(arguments);
  if (request.help) answer(help_text(), out);
  if (request.version) answer(fmt::format("qmorph {}\n", kVersion), out);
  if (request.help || request.version) return all_converted;
  const int status = run_with_streams(request, arguments, out, err, process);
  // Where it went wrong there is a line that says it, and nobody wants more.
  if (process.slate) process.slate->shows_foreign_words = request.verbosity >= 2 && status <= converted_in_part;
  return status;
}

}  // namespace

int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err_stream,
        const Process& process) {
  ErrorStream err(err_stream);
  try {
    hold_standard_streams();
    return run_request(arguments, out, err, process);
  } catch (const ReaderError& error) {
    for (const std::string& complaint : error.complaints) fail(not_good_enough, complaint, err);
    return not_good_enough;
  } catch (const UsageError& error) {
    return fail(bad_usage, error.what(), err);
  } catch (const OutputError& error) {
    return fail(cannot_write, error.what(), err);
  } catch (const Error& error) {
    return fail(bad_input, error.what(), err);
  } catch (const std::bad_alloc&) {
    return fail(bad_input, "not enough memory", err);
  } catch (const std::exception& error) {
    return fail(bad_input, fmt::format("a mistake of qmorph: {}", error.what()), err);
  } catch (const std::string& error) {  // Gmsh before 4.10
    return fail(bad_input, fmt::format("Gmsh: {}", error), err);
  } catch (...) {
    return fail(bad_input, "a mistake of qmorph", err);
  }
}

}  // namespace qmorph::cli
