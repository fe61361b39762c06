// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "cli/request/request.hpp"
#include "cli/request/rules.hpp"
#include "cli/request/translate.hpp"
#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

/// Gmsh's own default: everything but debugging.
constexpr int kDefaultVerbosity = 5;

/// In the place of CLI11's check, which tells the whole range of a double.
CLI::Validator whole_number(const std::string& option) {
  const auto check = [option](const std::string& text) {
    int number = 0;
    if (!CLI::detail::lexical_cast(text, number) || number < 0)
      throw UsageError(fmt::format("{} takes a whole number, 0 or more", option));
    return std::string();
  };
  return CLI::Validator(check, "");
}

int surface_tag(const std::string& text) {
  int tag = 0;
  if (!CLI::detail::lexical_cast(text, tag) || tag < 0)
    throw UsageError(fmt::format(
        "--surfaces: '{}' is not a tag; give the numbers of surfaces, as 3,7 (not of groups, nor names)", text));
  return tag;
}

void add_places(CLI::App& app, Request& request) {
  app.add_option("IN", request.merged);
  app.add_option("--o", request.output);
  app.add_option("--format,--f", request.format);
  app.add_flag_function("--bin", [&request](auto) { request.binary = true; });
  app.add_option("--for", request.consumer);
  app.add_option("--elements", request.elements);
}

void add_meshing(CLI::App& app, Request& request) {
  app.add_flag("--2");
  app.add_flag_function("--3", [&request](auto) { request.dimension = 3; });
  app.add_flag("--save", request.no_meshing);
  app.add_option("--part", request.partitions)->check(whole_number("-part"));
  app.add_option("--nt", request.threads)->check(whole_number("-nt"));
  app.add_option("--v", request.verbosity)->check(whole_number("-v"));
}

void add_conversion(CLI::App& app, Request& request) {
  const auto take_surfaces = [&request](const std::vector<std::string>& tags) {
    for (const std::string& tag : tags) request.surfaces.push_back(surface_tag(tag));
  };
  app.add_option_function<std::vector<std::string>>("--surfaces", take_surfaces)
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_flag("--drop-volumes", request.drop_volumes);
  app.add_flag("--all-quad", request.all_quad);
  app.add_option("--keep-curves", request.keep_curves)->delimiter(',')->allow_extra_args(false);
  app.add_flag("--cleanup-only", request.cleanup_only);
  app.add_flag("--orient", request.orient);
  app.add_option("--layers", request.layers)->check(CLI::IsMember({"on", "off"}));
  app.add_option("--crease", request.crease)->check(CLI::Range(0.0, 180.0));
  app.add_option("--smoothing", request.smoothing);
  app.add_option("--set", request.settings)->allow_extra_args(false);
}

void add_check(CLI::App& app, Request& request) {
  Thresholds& thresholds = request.thresholds;
  app.add_flag("--check", request.check);
  app.add_option("--min-sj", thresholds.min_scaled_jacobian)->check(CLI::Range(-1.0, 1.0));
  app.add_option("--max-irregular", thresholds.max_irregular)->check(CLI::Range(0.0, 1.0));
  app.add_flag("--no-triangles", thresholds.no_triangles);
  app.add_option("--against", request.against);
  app.add_option("--max-distance", thresholds.max_distance)->check(CLI::NonNegativeNumber);
  app.add_option("--max-size-ratio", thresholds.max_size_ratio)->check(CLI::Range(1.0, 1e9));
}

void add_side_files(CLI::App& app, Request& request) {
  app.add_option("--stats", request.stats);
  app.add_option("--report", request.report);
  app.add_option("--film", request.film);
  app.add_option("--depfile", request.depfile);
  app.add_option("--svg", request.svg);
  app.add_option("--pdf", request.pdf);
  app.add_option("--tikz", request.tikz);
  app.add_option("--stage", request.stage);
  app.add_option("--colour", request.colour);
  app.add_option("--from", request.from);
  app.add_flag("--views", request.views);
  app.add_flag("--view", request.view);
  app.add_flag("--gui", request.gui);
}

}  // namespace

Request parse(const std::vector<std::string>& arguments) {
  Request request;
  request.verbosity = kDefaultVerbosity;
  std::vector<std::string> words = translate(arguments, request);

  CLI::App app;
  app.set_help_flag();
  add_places(app, request);
  add_meshing(app, request);
  add_conversion(app, request);
  add_check(app, request);
  add_side_files(app, request);
  app.add_flag("--help", request.help);
  app.add_flag("--version", request.version);
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    throw UsageError(with_our_spelling(error.what()));
  }
  if (request.help || request.version) return request;
  if (!request.merged.empty()) {
    request.input = request.merged.front();
    request.merged.erase(request.merged.begin());
  } else if (!request.gui) {
    throw UsageError("which file? (qmorph IN [-o OUT])");
  }
  check_combination(request, [&app](const std::string& option) { return app.count(option) > 0; });
  return request;
}

}  // namespace qmorph::cli
