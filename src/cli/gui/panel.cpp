// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/gui/panel.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "cli/request/engine_options.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/window/live_window.hpp"
#include "qmorph/error.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cli {
namespace {

using Json = nlohmann::ordered_json;
using namespace parameter;

constexpr const char* kAll = "all";
constexpr const char* kConstants = "00qmorph/30Constants/";

/// Names of colourings, in the order of report::PictureColour.
constexpr std::array kColours = {"scaled Jacobian", "eta", "thesis", "size", "none"};

/// Figures of a result, in their order in the panel.
constexpr std::array kFigures = {"00qmorph/50Result/1Quads",     "00qmorph/50Result/2Triangles",
                                 "00qmorph/50Result/3Least SJ",  "00qmorph/50Result/4Mean SJ",
                                 "00qmorph/50Result/5Irregular", "00qmorph/50Result/6Left as they were",
                                 "00qmorph/50Result/7Seconds"};

/// Options with names that have a place of their own in the panel.
bool is_elsewhere(const std::string& name) { return name == "crease_angle"; }

Json number(const char* name, double value, double least, double most, double step) {
  return {{"type", "number"}, {"name", name}, {"values", {value}}, {"min", least}, {"max", most}, {"step", step}};
}

Json choice(const char* name, double value, const std::vector<std::pair<std::string, int>>& labels) {
  Json json{{"type", "number"}, {"name", name}, {"values", {value}}, {"choices", Json::array()}};
  for (const auto& [label, number] : labels) json["choices"].push_back(number), json["valueLabels"][label] = number;
  return json;
}

Json tick(const char* name, bool on) {
  return {{"type", "number"}, {"name", name}, {"values", {on ? 1 : 0}}, {"choices", {0, 1}}};
}

Json text(const char* name, const std::string& value, bool read_only = false) {
  return {{"type", "string"}, {"name", name}, {"values", {value}}, {"readOnly", read_only}};
}

Json file(const char* name, const std::string& path) {
  Json json = text(name, path);
  json["kind"] = "file";
  return json;
}

Json button(const std::string& name, const std::string& label, const char* action) {
  return {{"type", "string"},
          {"name", name},
          {"label", label},
          {"values", {action}},
          {"attributes", {{"Macro", "Action"}, {"Aspect", "Button"}}}};
}

std::string with_extension(const std::string& path, const char* extension) {
  const std::size_t dot = path.find_last_of('.'), slash = path.find_last_of('/');
  const bool has_dot = dot != std::string::npos && (slash == std::string::npos || dot > slash);
  return (has_dot ? path.substr(0, dot) : path) + extension;
}

/// What is to be converted, and how.
void add_conversion(const Request& request, Json& all) {
  all.push_back(number(kSizeFactor, adapter::get_option("Mesh.MeshSizeFactor"), 0.01, 100, 0.1));
  all.push_back(tick(kAllQuad, request.all_quad));
  all.push_back(tick(kCleanupOnly, request.cleanup_only));
  all.push_back(number(kCrease, get_option(engine_options(request), "crease_angle"), 0, 180, 5));
  all.push_back(text(kSurfaces, request.surfaces.empty() ? kAll : fmt::format("{}", fmt::join(request.surfaces, ","))));
  all.push_back(button("00qmorph/06Pick", "pick with the mouse", action::kPick));
  all.push_back(choice(kSmoothing, request.smoothing == "thesis", {{"shape energy", 0}, {"thesis", 1}}));
}

void add_views(const Request& request, Json& all) {
  std::vector<std::pair<std::string, int>> colours;
  for (const char* name : kColours) colours.emplace_back(name, static_cast<int>(colours.size()));
  const auto colour = report::find_picture_colour(request.colour);
  all.push_back(choice(kColour, colour ? static_cast<int>(*colour) : 0, colours));
  all.push_back(tick(kIrregular, true));
  all.push_back(button("00qmorph/10Back", "Back to triangles", action::kBack));
}

void add_steps(Json& all) {
  Json surface = number(kStepSurface, 0, 0, 1e9, 1);
  surface["label"] = "Surface (0: the first)";
  all.push_back(surface);
  all.push_back(choice(kSteps, 1, {{"1", 1}, {"10", 10}, {"100", 100}, {"a row", kWholeRow}}));
  all.push_back(choice(kFrontBy, 0, {{"level", 0}, {"state", 1}}));
  all.push_back(button("00qmorph/20Step/4Forward", "Step", action::kForward));
  all.push_back(button("00qmorph/20Step/5Backward", "Step back", action::kBackward));
  all.push_back(button("00qmorph/20Step/6Begin", "To the beginning", action::kToBegin));
  all.push_back(button("00qmorph/20Step/7End", "To the end", action::kToEnd));
  all.push_back(text(kStepDone, "", true));
  all.push_back(text(kStepWords, "", true));
}

void add_constants(const Request& request, Json& all) {
  const Options options = engine_options(request);
  for (const std::string& name : option_names()) {
    if (is_elsewhere(name)) continue;
    Json json{{"type", "number"}, {"name", kConstants + name}, {"values", {get_option(options, name)}}};
    json["attributes"]["Closed"] = "1";
    all.push_back(json);
  }
}

void add_files(const Request& request, Json& all) {
  const std::string input = request.input.empty() ? "untitled.geo" : request.input;
  const std::string mesh = request.output.empty() ? with_extension(input, "-quads.msh") : request.output;
  all.push_back(file(kMeshFile, mesh));
  all.push_back(button("00qmorph/40Files/2Save", "Save as", action::kSave));
  all.push_back(file(kReportFile, with_extension(mesh, "-report.html")));
  all.push_back(button("00qmorph/40Files/4Report", "Write the page", action::kReport));
  all.push_back(file(kFilmFile, with_extension(mesh, "-film.html")));
  all.push_back(button("00qmorph/40Files/6Film", "Write the film", action::kFilm));
  all.push_back(button("00qmorph/40Files/7Compare", "Gmsh's recombine", action::kCompare));
  for (auto it = all.end() - 7; it != all.end(); ++it) (*it)["attributes"]["Closed"] = "1";
}

/// "all", or tags with commas or blanks between them.
std::vector<int> parse_surfaces(std::string words) {
  for (char& c : words)
    if (c == ',' || c == ';') c = ' ';
  std::istringstream in(words);
  std::vector<int> tags;
  for (std::string word; in >> word;) {
    if (word == kAll) return {};
    std::size_t end = 0;
    int tag = -1;
    try {
      tag = std::stoi(word, &end);
    } catch (const std::exception&) {
      end = 0;
    }
    if (end != word.size() || tag < 0)
      throw UsageError(fmt::format("Surfaces: '{}' is not a tag; write all, or numbers as 3, 7", word));
    tags.push_back(tag);
  }
  return tags;
}

}  // namespace

void define_panel(const Request& request) {
  Json all = Json::array();
  add_conversion(request, all);
  add_views(request, all);
  add_steps(all);
  add_constants(request, all);
  add_files(request, all);
  for (const char* name : kFigures) all.push_back(text(name, "", true));
  all.push_back(
      {{"type", "string"}, {"name", "ONELAB/Button"}, {"values", {"Convert", action::kConvert}}, {"visible", false}});
  adapter::define_parameters(all.dump());
}

bool panel_is_there() { return adapter::has_parameter(kSizeFactor); }

Choices read_choices() {
  const auto whole = [](const char* name, int otherwise) {
    return static_cast<int>(adapter::number_parameter(name, otherwise));
  };
  Choices choices;
  choices.size_factor = adapter::number_parameter(kSizeFactor, 1);
  choices.colour = static_cast<report::PictureColour>(whole(kColour, 0));
  choices.irregular = whole(kIrregular, 1) != 0;
  choices.steps = whole(kSteps, 1);
  choices.step_surface = whole(kStepSurface, 0);
  choices.front = whole(kFrontBy, 0) == 0 ? FrontColour::level : FrontColour::state;
  return choices;
}

Request read_request(const Request& of_command_line) {
  Request request = of_command_line;
  request.all_quad = adapter::number_parameter(kAllQuad, 0) != 0;
  request.cleanup_only = adapter::number_parameter(kCleanupOnly, 0) != 0;
  request.surfaces = parse_surfaces(adapter::text_parameter(kSurfaces));
  request.smoothing = adapter::number_parameter(kSmoothing, 0) != 0 ? "thesis" : "";
  const Options before = engine_options(of_command_line);
  const double crease = get_option(before, "crease_angle");
  if (const double wish = adapter::number_parameter(kCrease, crease); wish != crease) request.crease = wish;
  for (const std::string& name : option_names()) {
    if (is_elsewhere(name)) continue;
    const double was = get_option(before, name), wish = adapter::number_parameter(kConstants + name, was);
    if (wish != was) request.settings.push_back(fmt::format("{}={}", name, wish));
  }
  request.output = adapter::text_parameter(kMeshFile);
  return request;
}

void show_figures(const ModelReport* model, double seconds) {
  std::array<std::string, kFigures.size()> words;
  if (model) {
    const Quality& q = model->total;
    std::size_t triangles = 0;
    for (const SurfaceReport& surface : model->surfaces) triangles += surface.triangles_out;
    std::vector<int> left;
    for (const SurfaceReport& surface : model->surfaces)
      if (surface.outcome == SurfaceOutcome::left) left.push_back(surface.tag);
    words = {fmt::format("{}", q.quads),
             fmt::format("{}", triangles),
             fmt::format("{:.3f}", q.scaled_jacobian_min),
             fmt::format("{:.3f}", q.scaled_jacobian_mean),
             fmt::format("{:.1f} %", 100 * q.irregular_share()),
             left.empty() ? "none" : fmt::format("{}", fmt::join(left, ", ")),
             fmt::format("{:.2f}", seconds)};
  }
  for (std::size_t i = 0; i < kFigures.size(); ++i) adapter::set_parameter(kFigures[i], words[i]);
}

}  // namespace qmorph::cli
