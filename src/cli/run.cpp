#include "cli/run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <utility>

#include "cli/check.hpp"
#include "cli/progress.hpp"
#include "cli/request.hpp"
#include "cli/scene.hpp"
#include "cli/side_files.hpp"
#include "cli/standard_streams.hpp"
#include "gmsh/convert/compare_sizes.hpp"
#include "gmsh/read/meshing.hpp"
#include "gmsh/read/open.hpp"
#include "gmsh/read/readable.hpp"
#include "gmsh/session/scratch_file.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/window/window.hpp"
#include "gmsh/write/consumers.hpp"
#include "gmsh/write/staged_file.hpp"
#include "gmsh/write/write.hpp"
#include "qmorph/gmsh.hpp"
#include "report/stats.hpp"
#include "report/summary.hpp"
#include "report/version.hpp"

namespace qmorph::cli {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

/// What Gmsh is told by the name of a file: meshes, STEP, BREP and scripts begin differently.
std::string extension_of(const std::string& text) {
  const std::string head = text.substr(0, 4096);
  const auto has = [&](const char* word) { return head.find(word) != std::string::npos; };
  if (has("$MeshFormat") || has("$NOD")) return ".msh";
  if (has("ISO-10303-21")) return ".step";
  return has("DBRep_DrawableShape") ? ".brep" : ".geo";
}

/// What a reader would not take, and why.
struct ReaderError {
  std::vector<std::string> complaints;
};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Also by different names, through links, and before there is such a file.
bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  const fs::path first = fs::weakly_canonical(fs::absolute(a, error), error);
  const fs::path second = fs::weakly_canonical(fs::absolute(b, error), error);
  return !first.empty() && first == second;
}

/// Refuses what would fail in the end before hours go into a mesh.
adapter::OutputPlan check_places(const Request& request) {
  adapter::check_readable(request.input);
  for (const std::string& file : request.merged) adapter::check_readable(file);
  std::vector<std::pair<std::string, std::string>> taken{{request.input, "the input"}};
  for (const auto& [option, path] : side_files(request)) {
    for (const auto& [other, what] : taken)
      if (is_same_file(path, other))
        throw UsageError(fmt::format("{} {} is {}; give it a file of its own", option, path, what));
    const adapter::StagedFile probe(path);
    taken.emplace_back(path, fmt::format("the file of {}", option));
  }
  std::string format = request.format;
  if (!request.consumer.empty()) {
    const std::string_view wanted = adapter::find_consumer(request.consumer).format;
    if (!adapter::is_element_family(request.elements))
      throw UsageError(fmt::format("--elements: '{}' is none of CPS, CPE, CAX, S, M3D, with or without an R behind it",
                                   request.elements));
    if (!format.empty() && format != wanted)
      throw UsageError(fmt::format("--for {} writes the format {}, not {}", request.consumer, wanted, format));
    format = wanted;
  }
  adapter::OutputPlan plan = adapter::plan_output(request.input, request.output, format);
  plan.for_reader = !request.consumer.empty();
  if (request.to_stdout) plan.name = "standard output";
  for (const auto& [option, path] : side_files(request))
    if (is_same_file(path, plan.path))
      throw UsageError(fmt::format("{} {} is the output; give it a file of its own", option, path));
  return plan;
}

int status_of(const ModelReport& model) {
  if (model.count(SurfaceOutcome::left)) return converted_in_part;
  return model.count(SurfaceOutcome::converted) ? all_converted : nothing_to_convert;
}

/// Nothing has changed: the output is to be the input, byte for byte.
bool is_as_it_was(const Request& request, const adapter::OutputPlan& plan, const adapter::OpenedModel& opened,
                  const ModelReport& model) {
  const bool same_format = opened.msh.version != 0 && plan.format.is_msh && plan.format.msh_version == 0 &&
                           !request.msh_version && !request.binary && request.merged.empty() && !request.views;
  const bool untouched = model.count(SurfaceOutcome::converted) == 0 && request.dimension != 3 &&
                         !request.drop_volumes && !request.order_chosen && request.partitions == 0;
  return same_format && untouched;
}

/// In the reader's terms. \throws ReaderError
void write_for_consumer(const Request& request, const adapter::OpenedModel& opened, adapter::StagedFile& file) {
  const adapter::Consumer& consumer = adapter::find_consumer(request.consumer);
  const adapter::ConsumerMesh mesh = adapter::collect_for(consumer, opened.msh.version != 0);
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

/// What the caller must know in any case, in one line.
void print_outcome(const ModelReport& model, const std::string& output, std::ostream& err) {
  std::string left;
  for (const SurfaceReport& surface : model.surfaces)
    if (surface.outcome == SurfaceOutcome::left) left += fmt::format("{}{}", left.empty() ? "" : ", ", surface.tag);
  if (!left.empty())
    err << fmt::format("qmorph: {} of {} surfaces left as they were: {}\n", model.count(SurfaceOutcome::left),
                       model.surfaces.size(), left);
  else if (model.count(SurfaceOutcome::converted) == 0)
    err << "qmorph: nothing to convert: all surfaces are quads already; " << output << " has the mesh as it was\n";
}

/// Gmsh may say one thing about each of a million nodes.
void print_once(std::string_view prefix, const std::vector<std::string>& lines, std::ostream& err) {
  std::map<std::string, std::size_t> count;
  for (const std::string& line : lines) ++count[line];
  for (const std::string& line : lines) {
    const std::size_t times = std::exchange(count[line], 0);
    if (times) err << prefix << line << (times > 1 ? fmt::format(" ({} times)", times) : "") << '\n';
  }
}

/// \param output what to call it
void print_summary(const Request& request, const adapter::OpenedModel& opened, const ModelReport& model,
                   const report::RunFacts& facts, const std::string& output, std::ostream& err) {
  if (request.verbosity >= 2) print_once("Gmsh: ", opened.warnings, err);
  if (request.verbosity >= 1) {
    for (const std::string& warning : model.warnings) err << "warning: " << warning << '\n';
    for (const SurfaceReport& surface : model.surfaces) {
      err << report::surface_line(surface) << '\n';
      for (const std::string& warning : surface.warnings)
        err << "warning: surface " << surface.tag << ": " << warning << '\n';
    }
    if (facts.even) err << report::even_line(*facts.even) << '\n';
    err << report::total_line(model, output, facts.total_seconds) << '\n';
  }
  print_outcome(model, output, err);
}

/// The mesh and all the other files, or none. \param mesh null if it is in its place already
void commit(adapter::StagedFile* mesh, const std::vector<SideFile>& others) {
  std::deque<adapter::StagedFile> staged;
  for (const SideFile& other : others) {
    staged.emplace_back(other.path).write_text(other.text);
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

adapter::OpenedModel open(const Request& request, std::ostream& err) {
  if (!request.algorithm_chosen) adapter::set_option("Mesh.Algorithm", adapter::kDefaultAlgorithm);
  if (!request.consumer.empty() && adapter::find_consumer(request.consumer).wants_incomplete)
    adapter::set_option("Mesh.SecondOrderIncomplete", 1);
  for (const std::string& name : request.option_names)
    if (!adapter::option_exists(name) && request.verbosity >= 1)
      err << "warning: this Gmsh has no option " << name << '\n';
  adapter::OpenedModel opened = adapter::open_model(
      request.input, {request.merged, request.background, request.no_meshing, request.ignore_periodicity});
  if (request.drop_volumes) adapter::drop_volumes();
  return opened;
}

/// The surfaces of the mesh that sizes are compared with.
std::map<int, Patch> read_before(const Request& request) {
  if (request.before.empty()) return {};
  adapter::check_readable(request.before);
  const adapter::Session session(request.gmsh_arguments);
  adapter::open_model(request.before, {{}, {}, true, request.ignore_periodicity});
  std::map<int, Patch> surfaces = adapter::read_surfaces();
  if (surfaces.empty()) throw InputError(fmt::format("{} has no surface with elements", request.before));
  return surfaces;
}

int check_file(const Request& request, std::ostream& out, std::ostream& err) {
  adapter::check_readable(request.input);
  ModelReport model;
  {
    const StdoutAsStderr redirected;
    const std::map<int, Patch> before = read_before(request);
    const adapter::Session session(request.gmsh_arguments);
    adapter::open_model(request.input, {request.merged, {}, true, request.ignore_periodicity});
    model = session::measure_surfaces(request.surfaces);
    adapter::compare_sizes(before, model);
  }
  if (model.surfaces.empty()) throw InputError(fmt::format("{} has no surface with elements", request.input));
  if (request.verbosity >= 1) answer(report::check_line(model) + '\n', out);
  const std::vector<std::string> reasons = find_reasons(model, request.thresholds);
  for (const std::string& reason : reasons) err << "qmorph: " << reason << '\n';
  return reasons.empty() ? all_converted : not_good_enough;
}

int convert_file(const Request& request, const std::vector<std::string>& arguments, std::ostream& err) {
  const Clock::time_point start = Clock::now();
  Options options = engine_options(request);
  const report::Wishes wishes = what_to_keep(request);
  report::Recorder recorder(wishes);
  if (wishes.any()) options.observer = &recorder;
  const adapter::OutputPlan plan = check_places(request);
  const StdoutAsStderr redirected;
  adapter::Session session(request.gmsh_arguments);
  adapter::check_format(plan);
  adapter::OpenedModel opened = open(request, err);

  const bool watched = request.verbosity >= 1 && &err == &std::cerr && ::isatty(STDERR_FILENO);
  std::optional<ProgressBar> bar;
  if (watched) options.progress = std::ref(bar.emplace(err));
  const report::Scene before = request.report.empty() ? report::Scene{} : read_scene();
  std::optional<EvenReport> even;
  if (request.all_quad) even = session::make_even(request.surfaces, request.keep_curves);
  const ModelReport model = request.cleanup_only ? session::improve_quads(options, request.surfaces)
                                                 : session::recombine(options, request.surfaces);
  bar.reset();
  if (model.surfaces.empty()) {
    err << "qmorph: nothing to convert: " << (request.from_stdin ? "standard input" : request.input)
        << " has no surface with elements\n";
    return nothing_to_convert;
  }

  const std::vector<std::string> bent = finish_model(request, opened, session);
  if (is_as_it_was(request, plan, opened, model)) even.reset();  // OUT has the curves of IN

  const Clock::time_point write_start = Clock::now();
  const adapter::MshWish wish{request.msh_version, request.binary};
  if (request.verbosity >= 1 && !is_as_it_was(request, plan, opened, model))
    for (const std::string& lost : adapter::describe_unwritten(plan, opened, wish)) err << "warning: " << lost << '\n';
  adapter::StagedFile file = adapter::stage(plan);
  const bool written = write(request, plan, opened, model, file);
  const int status = bent.empty() ? status_of(model) : converted_in_part;
  report::RunFacts facts{request.from_stdin ? "-" : request.input, request.to_stdout ? "-" : plan.path, arguments,
                         status, even};
  facts.open_seconds = opened.open_seconds;
  facts.mesh_seconds = opened.mesh_seconds;
  facts.write_seconds = seconds_since(write_start);
  facts.total_seconds = seconds_since(start);
  std::vector<SideFile> others = make_side_files(request, before, model, recorder, facts);
  if (request.views) {
    std::vector<SideFile> views = write_views(request, opened, plan.path, file);
    if (request.to_stdout && !views.empty())
      throw UsageError("--views: the standard output has no file beside it; write MSH 4, or give -o a name");
    std::move(views.begin(), views.end(), std::back_inserter(others));
  }
  commit(written ? &file : nullptr, others);
  print_summary(request, opened, model, facts, plan.name, err);
  for (const std::string& what : bent) err << "qmorph: " << what << '\n';
  if (request.view)
    if (const std::string problem = adapter::show_in_window(plan.path); !problem.empty())
      err << "qmorph: --view: " << problem << '\n';
  return facts.exit_status;
}

/// Standard input and output have names as files for as long as it takes.
int run_with_streams(Request request, const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  std::optional<adapter::ScratchFile> input, output;
  request.from_stdin = request.input == "-";
  request.to_stdout = request.output == "-" || (request.output.empty() && request.from_stdin);
  if (request.from_stdin) {
    const std::string text(std::istreambuf_iterator<char>(std::cin), {});
    input.emplace(extension_of(text));
    std::ofstream(input->path(), std::ios::binary) << text;
    request.input = input->path();
  }
  if (request.check) return check_file(request, out, err);
  if (!request.to_stdout) return convert_file(request, arguments, err);
  output.emplace(".msh");
  request.output = output->path();
  if (request.format.empty() && request.consumer.empty()) request.format = "msh";
  const int status = convert_file(request, arguments, err);
  answer_with_file(output->path(), out);
  return status;
}

int fail(int status, std::string_view what, std::ostream& err) {
  err << "qmorph: " << what << (status == bad_usage ? " (see qmorph --help)" : "") << '\n';
  return status;
}

}  // namespace

int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) try {
  hold_standard_streams();
  const Request request = parse(arguments);
  if (request.help) answer(help_text(), out);
  if (request.version) answer(fmt::format("qmorph {}\n", kVersion), out);
  if (request.help || request.version) return all_converted;
  return run_with_streams(request, arguments, out, err);
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

}  // namespace qmorph::cli
