// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/files/side_files.hpp"

#include <fmt/format.h>

#include <array>
#include <deque>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

#include "cli/files/scene.hpp"
#include "gmsh/read/msh/file.hpp"
#include "report/page.hpp"
#include "report/picture.hpp"
#include "report/views.hpp"

namespace qmorph::cli {
namespace {

constexpr std::array kStageNames = {std::pair("input", Stage::input), std::pair("front", Stage::front),
                                    std::pair("elimination", Stage::elimination),
                                    std::pair("smoothing", Stage::smoothing), std::pair("cleanup", Stage::cleanup)};

/// Nothing for the mesh in the end. \throws UsageError
std::optional<Stage> wanted_stage(const Request& request) {
  if (request.stage == "final") return std::nullopt;
  for (const auto& [name, stage] : kStageNames)
    if (request.stage == name) return stage;
  throw UsageError(fmt::format("--stage: there is no stage '{}' (input, front, elimination, smoothing, cleanup, final)",
                               request.stage));
}

/// \throws UsageError
report::PictureColour wanted_colour(const Request& request) {
  const auto colour = report::find_picture_colour(request.colour);
  if (!colour)
    throw UsageError(fmt::format("--colour: there is no colouring '{}' (sj, eta, thesis, size, none)", request.colour));
  return *colour;
}

/// \throws UsageError
report::Viewpoint wanted_viewpoint(const Request& request) {
  if (request.from.empty()) return report::Viewpoint::Zero();
  const auto from = report::find_viewpoint(request.from);
  if (!from)
    throw UsageError(fmt::format("--from: '{}' is no direction (x, y, z, -x, -y, -z, or three numbers as in 1,-2,0.5)",
                                 request.from));
  return *from;
}

void add_pictures(const Request& request, const report::Scene& after, const ModelReport& model,
                  const report::Recorder& recorder, std::vector<SideFile>& files) {
  const std::optional<Stage> stage = wanted_stage(request);
  const report::Drawing drawing = report::draw(stage ? report::at_stage(after, model, recorder, *stage) : after,
                                               wanted_colour(request), wanted_viewpoint(request));
  if (!request.svg.empty()) files.push_back({request.svg, report::to_svg(drawing)});
  if (!request.pdf.empty()) files.push_back({request.pdf, report::to_pdf(drawing)});
  if (!request.tikz.empty()) files.push_back({request.tikz, report::to_tikz(drawing)});
}

}  // namespace

std::vector<std::pair<std::string, std::string>> side_files(const Request& request) {
  std::vector<std::pair<std::string, std::string>> files;
  const std::array all = {std::pair("--stats", &request.stats),    std::pair("--report", &request.report),
                          std::pair("--film", &request.film),      std::pair("--svg", &request.svg),
                          std::pair("--pdf", &request.pdf),        std::pair("--tikz", &request.tikz),
                          std::pair("--depfile", &request.depfile)};
  for (const auto& [option, path] : all)
    if (!path->empty()) files.emplace_back(option, *path);
  return files;
}

report::Wishes what_to_keep(const Request& request) {
  report::Wishes wishes;
  wishes.meshes = request.wants_picture() && wanted_stage(request).has_value();
  wanted_colour(request);
  wanted_viewpoint(request);
  wishes.figures = !request.stats.empty() || !request.report.empty() || wishes.meshes;
  wishes.films = !request.film.empty();
  return wishes;
}

std::vector<SideFile> make_side_files(const Request& request, const report::Scene& before, const ModelReport& model,
                                      const report::Recorder& recorder, const report::RunFacts& facts) {
  std::vector<SideFile> files;
  const report::Viewpoint from = wanted_viewpoint(request);
  if (!request.stats.empty()) files.push_back({request.stats, report::stats_json(model, recorder, facts)});
  if (!request.film.empty()) files.push_back({request.film, report::film_page(model, recorder, facts, from)});
  if (request.report.empty() && !request.wants_picture()) return files;
  const report::Scene after = read_scene();
  if (!request.report.empty())
    files.push_back({request.report, report::report_page(before, after, model, recorder, facts, from)});
  if (request.wants_picture()) add_pictures(request, after, model, recorder, files);
  return files;
}

std::vector<SideFile> write_views(const Request& request, const adapter::OpenedModel& opened, const std::string& output,
                                  const adapter::StagedFile& mesh) {
  const report::Scene scene = read_scene();
  const bool is_msh = std::filesystem::path(mesh.path()).extension() == ".msh" && request.consumer.empty();
  const adapter::MshHeader header = is_msh ? adapter::read_msh_header(mesh.path()) : adapter::MshHeader{};
  // Gmsh numbers elements anew in files of older versions; our own writer does not.
  if (!header.is_4() && !(header.version == 2.2 && opened.msh.is_2()))
    return {{std::filesystem::path(output).replace_extension(".pos").string(), report::pos_views(scene)}};
  std::ofstream file(mesh.path(), std::ios::binary | std::ios::app);
  file << report::msh_views(scene, header.binary) << std::flush;
  if (!file) throw OutputError(fmt::format("cannot write {}: the views do not fit; is the disk full?", output));
  return {};
}

void put_in_place(adapter::StagedFile* mesh, const std::vector<SideFile>& others, adapter::TemporaryNames* names) {
  std::deque<adapter::StagedFile> staged;
  for (const SideFile& other : others) {
    staged.emplace_back(other.path, std::string(), names).write_text(other.text);
    staged.back().prepare();
  }
  if (mesh) mesh->commit();
  for (adapter::StagedFile& file : staged) file.commit();
}

}  // namespace qmorph::cli
