// SPDX-License-Identifier: GPL-2.0-or-later
// The buttons below "Files".
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "cli/files/scene.hpp"
#include "cli/gui/compare.hpp"
#include "cli/gui/gui.hpp"
#include "gmsh/write/staged_file.hpp"
#include "qmorph/error.hpp"
#include "report/page.hpp"
#include "report/recorder.hpp"

namespace qmorph::cli {
namespace {

void write_text(const std::string& path, const std::string& text, const Call& call) {
  adapter::StagedFile file(path, std::string(), call.names());
  file.write_text(text);
  file.commit();
}

}  // namespace

void Gui::save() {
  const Request request = read_request(call_.request);
  const std::string path = document_.target(request);
  if (!may_write(path)) return;
  for (const std::string& line : document_.save(request)) say(line);
  saved_[path] = document_.shows_triangles();
  if (document_.shows_triangles())
    say(path + " has the triangles, not the quads: Convert, or step to the end, and save once more for those",
        adapter::Severity::warning);
}

/// A file that is not ours, or has the quads where there are triangles now, is written over by a second press only.
bool Gui::may_write(const std::string& path) {
  const bool asked = std::exchange(asked_, std::string()) == path;
  const auto ours = saved_.find(path);
  std::error_code error;
  const bool free = !std::filesystem::exists(path, error) && !error;
  if (asked || free || (ours != saved_.end() && ours->second == document_.shows_triangles())) return true;
  say(fmt::format("{} is there already: press Save once more to write {} over it", path,
                  document_.shows_triangles() ? "the triangles" : "the mesh"),
      adapter::Severity::warning);
  asked_ = path;
  return false;
}

report::RunFacts Gui::facts(const Request& request, const std::string& output) const {
  report::RunFacts facts{request.input, output, call_.arguments, all_converted, document_.converted()->even};
  if (document_.converted()->model.count(SurfaceOutcome::left)) facts.exit_status = converted_in_part;
  facts.total_seconds = document_.converted()->seconds;
  return facts;
}

void Gui::write_report() {
  const std::string path = adapter::text_parameter(parameter::kReportFile);
  adapter::check_place(path);
  report::Recorder recorder({.figures = true});
  if (!convert([&] { return &recorder; })) return;
  document_.back_to_triangles();
  const report::Scene before = read_scene();
  document_.forward_to_quads();
  const ModelReport& model = document_.converted()->model;
  const Request request = read_request(call_.request);
  write_text(path, report::report_page(before, read_scene(), model, recorder, facts(request, request.output)), call_);
  say(path + " is written");
}

void Gui::write_film() {
  const std::string path = adapter::text_parameter(parameter::kFilmFile);
  const Request request = read_request(call_.request);
  if (request.cleanup_only) throw UsageError("Clean up only: there is no front then");
  adapter::check_place(path);
  report::Recorder recorder({.films = true});
  if (!convert([&] { return &recorder; })) return;
  const ModelReport& model = document_.converted()->model;
  write_text(path, report::film_page(model, recorder, facts(request, request.output)), call_);
  say(path + " is written");
}

void Gui::compare() {
  if (!document_.converted() || document_.shows_triangles())
    if (!convert()) return;
  show();
  say(compare_with_gmsh(document_.triangles(), choices_.colour, choices_.irregular, views_));
}

}  // namespace qmorph::cli
