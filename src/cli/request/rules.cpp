// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/request/rules.hpp"

#include <algorithm>
#include <array>

#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

/// Options that are on the command line, as --help spells them.
using Given = std::span<const std::string_view>;

bool has(Given given, std::string_view option) { return std::find(given.begin(), given.end(), option) != given.end(); }

constexpr std::array kThresholds = {"--min-sj",  "--max-irregular", "--no-triangles",
                                    "--against", "--max-distance",  "--max-size-ratio"};

/// What asks for a file.
constexpr std::array kWriting = {"-o",    "--for", "--stats", "--report",  "--film",
                                 "--svg", "--pdf", "--tikz",  "--depfile", "--views"};

/// What asks for another mesh.
constexpr std::array kChanging = {"--drop-volumes", "--all-quad", "--cleanup-only", "--orient",
                                  "--layers",       "--crease",   "--smoothing",    "--set"};

bool any(Given given, const auto& options) {
  return std::any_of(options.begin(), options.end(), [&](const char* option) { return has(given, option); });
}

void check_thresholds(const Request& request, Given given) {
  if (!request.check && any(given, kThresholds))
    throw UsageError(
        "--min-sj, --max-irregular, --no-triangles, --against, --max-distance and --max-size-ratio go with --check");
  if (any(given, std::array{"--max-distance", "--max-size-ratio"}) && !has(given, "--against"))
    throw UsageError(
        "--max-distance and --max-size-ratio compare with other triangles; name their mesh: --against FILE");
  if (!request.check) return;
  for (const std::string option : kWriting)
    if (has(given, option)) throw UsageError("--check writes nothing; leave out " + option);
  for (const std::string option : kChanging)
    if (has(given, option)) throw UsageError("--check changes nothing; leave out " + option);
}

void check_conversion(const Request& request, Given given) {
  if (request.all_quad && request.cleanup_only)
    throw UsageError("--all-quad is for the conversion of triangles; --cleanup-only takes curves as they are");
  if (!request.film.empty() && request.cleanup_only)
    throw UsageError("--film shows the front, and --cleanup-only has none");
  if (has(given, "--layers") && request.cleanup_only)
    throw UsageError("--layers is about rows of triangles; --cleanup-only finds quads");
}

/// The window asks for names of files itself.
constexpr std::array kNotInTheWindow = {"--check", "--for",  "--stats",   "--report", "--film", "--svg",
                                        "--pdf",   "--tikz", "--depfile", "--views",  "--view"};

void check_window(const Request& request, Given given) {
  if (!request.gui) return;
  if (request.input == "-" || request.output == "-") throw UsageError("--gui: the window reads and writes files");
  for (const std::string option : kNotInTheWindow)
    if (has(given, option)) throw UsageError("--gui has a panel for what is to be done; leave out " + option);
}

void check_places(const Request& request, Given given) {
  if (request.input == "-" ? !request.merged.empty()
                           : std::count(request.merged.begin(), request.merged.end(), "-") > 0)
    throw UsageError(
        "-: the standard input is read alone; gmsh's \"parse and exit\" is not here, since it writes nothing");
  if (has(given, "--elements") && request.consumer != "calculix" && request.consumer != "abaqus")
    throw UsageError("--elements goes with --for calculix or abaqus");
  if (any(given, std::array{"--stage", "--colour"}) && !request.wants_picture())
    throw UsageError("--stage and --colour are for pictures: --svg, --pdf or --tikz");
  if (has(given, "--from") && !request.wants_picture() && request.report.empty() && request.film.empty())
    throw UsageError("--from is for pictures and pages: --svg, --pdf, --tikz, --report or --film");
  if (!request.depfile.empty() && (request.output == "-" || (request.output.empty() && request.input == "-")))
    throw UsageError("--depfile: a rule for make needs a target; give -o a name");
}

}  // namespace

void check_combination(const Request& request, Given given) {
  check_window(request, given);
  check_places(request, given);
  check_thresholds(request, given);
  check_conversion(request, given);
}

}  // namespace qmorph::cli
