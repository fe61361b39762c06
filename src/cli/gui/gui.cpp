// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/gui/gui.hpp"

#include <fmt/format.h>

#include <exception>
#include <functional>
#include <map>
#include <utility>

#include "cli/files/scene.hpp"
#include "cli/gui/compare.hpp"
#include "cli/gui/front_view.hpp"
#include "cli/gui/progress.hpp"
#include "cli/gui/result_view.hpp"
#include "cli/process/standard_streams.hpp"
#include "cli/request/engine_options.hpp"
#include "cli/work/open_input.hpp"
#include "gmsh/window/second_model.hpp"
#include "gmsh/window/window.hpp"
#include "gmsh/write/staged_file.hpp"
#include "qmorph/error.hpp"
#include "report/page.hpp"
#include "report/recorder.hpp"
#include "report/summary.hpp"

namespace qmorph::cli {
namespace {

using adapter::Severity;

std::vector<int> surfaces_left(const ModelReport& model) {
  std::vector<int> left;
  for (const SurfaceReport& surface : model.surfaces)
    if (surface.outcome == SurfaceOutcome::left) left.push_back(surface.tag);
  return left;
}

void write_text(const std::string& path, const std::string& text, const Call& call) {
  adapter::StagedFile file(path, std::string(), call.names());
  file.write_text(text);
  file.commit();
}

/// While the library works, the button stops it.
class WorkingButton {
 public:
  explicit WorkingButton(adapter::LiveWindow& window) : window_(window) {
    adapter::set_button("Cancel", action::kCancel);
    window_.refresh();
  }
  ~WorkingButton() { adapter::set_button("Convert", action::kConvert); }
  WorkingButton(const WorkingButton&) = delete;
  WorkingButton& operator=(const WorkingButton&) = delete;

 private:
  adapter::LiveWindow& window_;
};

}  // namespace

Gui::Gui(const Call& call, adapter::Session& session)
    : err_(messages_), call_{call.request, call.arguments, call.out, err_, call.process}, document_(call_, session) {
  document_.open();
  define_panel(call_.request);
  choices_ = read_choices();
  parameters_ = adapter::other_parameters(parameter::kGroup);
  adapter::set_mesh_look();
  window_.refresh();
}

void Gui::turn(double seconds) {
  window_.turn(seconds);
  if (!window_.is_open()) return;
  const std::string action = adapter::take_action();
  if (document_.has_changed_hands()) {
    views_.forget();
    player_.reset();
    parameters_ = adapter::other_parameters(parameter::kGroup);
    show_figures(nullptr, 0);
  }
  if (!panel_is_there()) {  // the gear can reset all parameters
    define_panel(call_.request);
    window_.refresh();
  }
  if (!action.empty()) act(action);
}

void Gui::act(const std::string& action) {
  call_.begin(bad_input, "Gmsh's window crashed");
  try {
    do_action(action);
  } catch (const Cancelled&) {
    say("cancelled: the triangles are as they were", Severity::warning);
  } catch (const Error& error) {
    say(error.what(), Severity::warning);
  } catch (const std::bad_alloc&) {
    say("not enough memory", Severity::warning);
  } catch (const std::exception& error) {
    say(error.what(), Severity::warning);
  } catch (const std::string& error) {  // Gmsh before 4.10
    say("Gmsh: " + error, Severity::warning);
  }
  err_.flush();
  if (const std::string text = messages_.str(); !text.empty()) say(text, Severity::warning), messages_.str("");
  window_.refresh();
}

void Gui::do_action(const std::string& name) {
  const std::map<std::string, std::function<void()>> actions = {
      {"check", [&] { choices_changed(); }},
      {action::kConvert, [&] { leave_front(), convert(); }},
      {action::kBack, [&] { back(); }},
      {action::kPick, [&] { pick(); }},
      {action::kForward, [&] { step(name); }},
      {action::kBackward, [&] { step(name); }},
      {action::kToBegin, [&] { step(name); }},
      {action::kToEnd, [&] { step(name); }},
      {action::kSave, [&] { save(); }},
      {action::kReport, [&] { leave_front(), write_report(); }},
      {action::kFilm, [&] { leave_front(), write_film(); }},
      {action::kCompare, [&] { leave_front(), compare(); }},
  };
  if (const auto found = actions.find(name); found != actions.end()) found->second();
}

void Gui::choices_changed() {
  const std::string parameters = std::exchange(parameters_, adapter::other_parameters(parameter::kGroup));
  if (parameters != parameters_) {
    leave_front();
    views_.clear();
    if (document_.reopen()) show_figures(nullptr, 0);
  }
  const Choices before = std::exchange(choices_, read_choices());
  const bool result = before.colour != choices_.colour || before.irregular != choices_.irregular;
  if (watches_front() ? before.front != choices_.front : result) show();
}

/// \return false if there was nothing to convert
bool Gui::convert(Observer* observer) {
  choices_ = read_choices();
  const Request request = read_request(call_.request);
  Options options = engine_options(request);
  options.observer = observer;
  player_.reset();
  views_.clear();
  adapter::remove_second_model();
  const WorkingButton button(window_);
  std::optional<WindowProgress> progress;
  const Converted* converted = nullptr;
  try {
    converted = &document_.convert(request, choices_.size_factor, options, [&](Options& now) {
      now.progress = std::ref(progress.emplace(window_));  // the model is what is converted now
    });
  } catch (const Cancelled&) {
    if (!progress || !progress->model_changed()) throw;
    throw InputError("the model has become another one while it was being converted: nothing was done");
  }
  if (converted->model.surfaces.empty()) {
    say("nothing to convert: there is no surface with elements", Severity::warning);
    return false;
  }
  tell(*converted);
  show_figures(&converted->model, converted->seconds);
  show();
  return true;
}

void Gui::tell(const Converted& converted) {
  for (const std::string& warning : converted.model.warnings) say(warning, Severity::warning);
  for (const SurfaceReport& surface : converted.model.surfaces) {
    const bool left = surface.outcome == SurfaceOutcome::left;
    say(report::surface_line(surface), left ? Severity::warning : Severity::information);
    for (const std::string& warning : surface.warnings)
      say(fmt::format("surface {}: {}", surface.tag, warning), Severity::warning);
  }
  if (converted.even) say(report::even_line(*converted.even));
  say(report::total_line(converted.model, "in the window", converted.seconds));
}

/// The views that belong to what is there: a front, or a result.
void Gui::show() {
  if (watches_front()) {
    adapter::show_surface(player_->surface(), false);
    adapter::show_curves(false);  // the front begins there
    show_front(*player_, choices_.front, views_);
    return;
  }
  if (const Converted* converted = document_.converted(); converted && !document_.shows_triangles())
    show_result(read_scene(), choices_.colour, choices_.irregular, surfaces_left(converted->model), views_);
}

void Gui::leave_front() {
  if (!player_) return;
  adapter::show_surface(player_->surface(), true);
  adapter::show_curves(true);
  adapter::set_parameter(parameter::kStepDone, std::string());
  adapter::set_parameter(parameter::kStepWords, std::string());
  views_.clear();
  player_.reset();
}

void Gui::back() {
  leave_front();
  views_.clear();
  const bool there = document_.shows_triangles() || document_.back_to_triangles();
  if (!there) say("there is nothing to go back to", Severity::warning);
  if (there) say("these are the triangles again");
  show_figures(nullptr, 0);
}

void Gui::pick() {
  say("click on surfaces, then press e; q: give up");
  const std::vector<int> tags = window_.pick_surfaces();
  std::string words;
  for (int tag : tags) words += fmt::format("{}{}", words.empty() ? "" : ", ", tag);
  adapter::set_parameter(parameter::kSurfaces, words.empty() ? "all" : words);
}

/// Converts with an eye on one surface, and goes back to its triangles. \return false if it has no front
bool Gui::record() {
  choices_ = read_choices();
  const Request request = read_request(call_.request);
  if (request.cleanup_only) throw UsageError("Clean up only: there is no front then");
  // What the surfaces are is known once there is a mesh.
  std::optional<FrontWatcher> watcher;
  const auto choose = [&](int wanted) { watcher.emplace(wanted); };
  if (choices_.step_surface == 0) {
    if (!document_.converted() || document_.shows_triangles()) {
      if (!convert()) return false;
    }
    for (const SurfaceReport& surface : document_.converted()->model.surfaces)
      if (surface.outcome == SurfaceOutcome::converted && !watcher) choose(surface.tag);
    if (!watcher) throw InputError("no surface has become quads: there is no front to watch");
  } else {
    choose(choices_.step_surface);
  }
  const int surface = watcher->surface();
  if (!convert(&*watcher)) return false;
  std::vector<std::unique_ptr<FrontLog>> logs = watcher->take();
  if (logs.empty())
    throw InputError(fmt::format("surface {} has no front: it is not there, or nothing of it was converted", surface));
  document_.back_to_triangles();
  player_.emplace(surface, std::move(logs));
  return true;
}

void Gui::step(const std::string& name) {
  const Choices now = read_choices();
  if (player_ && now.step_surface != 0 && now.step_surface != player_->surface()) leave_front();
  if (!player_ && !record()) return;
  choices_ = now;
  const std::size_t n = static_cast<std::size_t>(std::max(1, now.steps)), at = player_->position();
  const bool row = now.steps == kWholeRow;
  std::size_t to = 0;
  if (name == action::kForward) to = row ? player_->row_end() : at + n;
  if (name == action::kBackward) to = row ? player_->row_begin() : at - std::min(at, n);
  if (name == action::kToEnd) to = player_->count();
  player_->go_to(to);
  const bool end = player_->position() == player_->count();
  if (end != !document_.shows_triangles()) end ? document_.forward_to_quads() : document_.back_to_triangles();
  if (end) adapter::show_surface(player_->surface(), true), adapter::show_curves(true);
  adapter::set_parameter(parameter::kStepDone, fmt::format("{} of {}", player_->position(), player_->count()));
  adapter::set_parameter(parameter::kStepWords, player_->words());
  show();
  window_.status(player_->words());
}

void Gui::save() {
  const Request request = read_request(call_.request);
  if (player_ && document_.shows_triangles())
    say("the front has not come to its end: what is written has triangles", Severity::warning);
  for (const std::string& line : document_.save(request)) say(line);
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
  if (!convert(&recorder)) return;
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
  if (!convert(&recorder)) return;
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

void Gui::say(const std::string& text, Severity severity) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) said_.push_back(line);
  adapter::log_line(text, severity);
  if (!said_.empty()) window_.status(said_.back());
}

int show_gui(const Call& call) {
  const StdoutAsStderr redirected;
  adapter::Session session(call.request.gmsh_arguments);
  begin_session(call, session);
  if (const std::string reason = adapter::find_no_window(); !reason.empty()) throw UsageError("--gui: " + reason);
  call.begin(bad_usage, "--gui: the window cannot be opened");
  Gui gui(call, session);
  while (gui.is_open()) gui.turn(-1);
  return all_converted;
}

}  // namespace qmorph::cli
