#include "cli/run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <new>
#include <optional>
#include <utility>

#include "cli/progress.hpp"
#include "cli/request.hpp"
#include "gmsh/open.hpp"
#include "gmsh/session.hpp"
#include "gmsh/staged_file.hpp"
#include "gmsh/write.hpp"
#include "qmorph/gmsh.hpp"
#include "report/stats.hpp"
#include "report/summary.hpp"
#include "report/version.hpp"

namespace qmorph::cli {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

/// OpenCASCADE speaks on the standard output, which is ours. For the time of this object's life that is the standard
/// error.
class StdoutAsStderr {
 public:
  StdoutAsStderr() {
    flush();
    saved_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (saved_ >= 0) ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ~StdoutAsStderr() {
    flush();
    if (saved_ < 0) return;
    ::dup2(saved_, STDOUT_FILENO);
    ::close(saved_);
  }
  StdoutAsStderr(const StdoutAsStderr&) = delete;
  StdoutAsStderr& operator=(const StdoutAsStderr&) = delete;

 private:
  static void flush() {
    std::cout.flush();
    std::fflush(stdout);
  }
  int saved_ = -1;
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
  const auto refuse_stats_at = [&](const std::string& path, std::string_view what) {
    if (!request.stats.empty() && is_same_file(request.stats, path))
      throw UsageError(fmt::format("--stats {} is the {}; give the figures a file of their own", request.stats, what));
  };
  refuse_stats_at(request.input, "input");
  if (!request.stats.empty()) const adapter::StagedFile probe(request.stats);
  const adapter::OutputPlan plan = adapter::plan_output(request.input, request.output, request.format);
  refuse_stats_at(plan.path, "output");
  return plan;
}

int status_of(const ModelReport& model) {
  if (model.count(SurfaceOutcome::kLeft)) return kConvertedInPart;
  return model.count(SurfaceOutcome::kConverted) ? kAllConverted : kNothingToConvert;
}

/// Writes the mesh to a file beside its place. \return false if the output is the input and stays what it is
bool write(const Request& request, const adapter::OutputPlan& plan, const adapter::OpenedModel& opened,
           const ModelReport& model, adapter::StagedFile& file) {
  const bool converted = model.count(SurfaceOutcome::kConverted) != 0;
  const bool as_it_was = !converted && opened.msh.version != 0 && plan.format.is_msh && plan.format.msh_version == 0 &&
                         !request.msh_version && !request.binary;
  if (as_it_was && is_same_file(request.input, plan.path)) return false;
  if (as_it_was)
    adapter::copy_input(request.input, plan, file);
  else
    adapter::write_model(plan, opened, {request.msh_version, request.binary}, file);
  return true;
}

/// What the caller must know in any case, in one line.
void print_outcome(const ModelReport& model, const std::string& output, std::ostream& err) {
  std::string left;
  for (const SurfaceReport& surface : model.surfaces)
    if (surface.outcome == SurfaceOutcome::kLeft) left += fmt::format("{}{}", left.empty() ? "" : ", ", surface.tag);
  if (!left.empty())
    err << fmt::format("qmorph: {} of {} surfaces left as they were: {}\n", model.count(SurfaceOutcome::kLeft),
                       model.surfaces.size(), left);
  else if (model.count(SurfaceOutcome::kConverted) == 0)
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

void print_summary(const Request& request, const adapter::OpenedModel& opened, const ModelReport& model,
                   const report::RunFacts& facts, std::ostream& err) {
  if (request.verbosity >= 2) print_once("Gmsh: ", opened.warnings, err);
  if (request.verbosity >= 1) {
    for (const std::string& warning : model.warnings) err << "warning: " << warning << '\n';
    for (const SurfaceReport& surface : model.surfaces) {
      err << report::surface_line(surface) << '\n';
      for (const std::string& warning : surface.warnings)
        err << "warning: surface " << surface.tag << ": " << warning << '\n';
    }
    err << report::total_line(model, facts.output, facts.total_seconds) << '\n';
  }
  print_outcome(model, facts.output, err);
}

/// The mesh and the figures, or neither. \param mesh null if it is in its place already
void commit(const Request& request, adapter::StagedFile* mesh, const std::string& figures) {
  std::optional<adapter::StagedFile> stats;
  if (!request.stats.empty()) {
    stats.emplace(request.stats);
    stats->write_text(figures);
    stats->prepare();
  }
  if (mesh) mesh->commit();
  if (stats) stats->commit();
}

/// The options of the engine that --set names.
Options engine_options(const std::vector<std::string>& settings) {
  Options options;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (value.empty() || *end) throw UsageError(fmt::format("--set {}: it takes NAME=NUMBER", setting));
    set_option(options, setting.substr(0, equals), number);
  }
  return options;
}

int convert_file(const Request& request, const std::vector<std::string>& arguments, std::ostream& err) {
  const Clock::time_point start = Clock::now();
  Options options = engine_options(request.settings);
  const adapter::OutputPlan plan = check_places(request);
  const StdoutAsStderr redirected;
  const adapter::Session session(request.gmsh_arguments);
  adapter::check_format(plan);
  if (!request.algorithm_chosen) adapter::set_option("Mesh.Algorithm", adapter::kDefaultAlgorithm);
  for (const std::string& name : request.option_names)
    if (!adapter::option_exists(name) && request.verbosity >= 1)
      err << "warning: this Gmsh has no option " << name << '\n';
  const adapter::OpenedModel opened = adapter::open_model(request.input);

  const bool watched = request.verbosity >= 1 && &err == &std::cerr && ::isatty(STDERR_FILENO);
  if (watched) options.progress = Progress(err);
  options.measure_stages = !request.stats.empty();
  const ModelReport model =
      request.cleanup_only ? improve_quads(request.surfaces, options) : recombine(request.surfaces, options);
  if (model.surfaces.empty()) {
    err << "qmorph: nothing to convert: " << request.input << " has no surface with elements\n";
    return kNothingToConvert;
  }

  const Clock::time_point write_start = Clock::now();
  if (!opened.had_mesh) adapter::renumber();
  if (request.verbosity >= 1) {
    const std::string lost = adapter::describe_unwritten(plan, opened);
    if (!lost.empty()) err << "warning: " << lost << '\n';
  }
  adapter::StagedFile file = adapter::stage(plan);
  const bool written = write(request, plan, opened, model, file);
  report::RunFacts facts{request.input, plan.path, arguments, status_of(model)};
  facts.open_seconds = opened.open_seconds;
  facts.mesh_seconds = opened.mesh_seconds;
  facts.write_seconds = seconds_since(write_start);
  facts.total_seconds = seconds_since(start);
  commit(request, written ? &file : nullptr, report::stats_json(model, facts));
  print_summary(request, opened, model, facts, err);
  return facts.exit_status;
}

int fail(int status, std::string_view what, std::ostream& err) {
  err << "qmorph: " << what << (status == kBadUsage ? " (see qmorph --help)" : "") << '\n';
  return status;
}

}  // namespace

int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) try {
  const Request request = parse(arguments);
  if (request.help) out << help_text();
  if (request.version) out << "qmorph " << kVersion << '\n';
  if (request.help || request.version) return kAllConverted;
  return convert_file(request, arguments, err);
} catch (const UsageError& error) {
  return fail(kBadUsage, error.what(), err);
} catch (const OutputError& error) {
  return fail(kCannotWrite, error.what(), err);
} catch (const Error& error) {
  return fail(kBadInput, error.what(), err);
} catch (const std::bad_alloc&) {
  return fail(kBadInput, "not enough memory", err);
} catch (const std::exception& error) {
  return fail(kBadInput, fmt::format("a mistake of qmorph: {}", error.what()), err);
} catch (const std::string& error) {  // Gmsh before 4.10
  return fail(kBadInput, fmt::format("Gmsh: {}", error), err);
} catch (...) {
  return fail(kBadInput, "a mistake of qmorph", err);
}

}  // namespace qmorph::cli
