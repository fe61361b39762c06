// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/gui/gui.hpp"

#include <fmt/format.h>

#include <exception>
#include <functional>
#include <map>
#include <utility>

#include "cli/files/scene.hpp"
#include "cli/gui/front_view.hpp"
#include "cli/gui/progress.hpp"
#include "cli/gui/result_view.hpp"
#include "cli/process/standard_streams.hpp"
#include "cli/request/engine_options.hpp"
#include "cli/work/open_input.hpp"
#include "gmsh/window/second_model.hpp"
#include "gmsh/window/window.hpp"
#include "qmorph/error.hpp"
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
bool Gui::convert(const std::function<Observer*()>& watch) {
  choices_ = read_choices();
  const Request request = read_request(call_.request);
  const Options options = engine_options(request);
  player_.reset();
  views_.clear();
  adapter::remove_second_model();
  const WorkingButton button(window_);
  std::optional<WindowProgress> progress;
  const Converted* converted = nullptr;
  try {
    converted = &document_.convert(request, choices_.size_factor, options, [&](Options& now) {
      if (watch) now.observer = watch();
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

void Gui::back() {
  leave_front();
  views_.clear();
  const bool there = document_.shows_triangles() || document_.back_to_triangles();
  if (!there) say("there is nothing to go back to", Severity::warning);
  if (there) say("these are the triangles again");
  show_figures(nullptr, 0);
}

void Gui::pick() {
  leave_front();  // its surface cannot be seen
  show();
  say("click on the crosses (dashed lines) of surfaces, then press e; q gives up");
  const std::vector<int> tags = window_.pick_surfaces();
  std::string words;
  for (int tag : tags) words += fmt::format("{}{}", words.empty() ? "" : ", ", tag);
  adapter::set_parameter(parameter::kSurfaces, words.empty() ? "all" : words);
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
  const adapter::Display display;
  if (!display.trouble().empty()) throw UsageError("--gui: " + display.trouble());
  call.begin(bad_usage, "--gui: the window cannot be opened");
  Gui gui(call, session);
  while (gui.is_open()) gui.turn(-1);
  return all_converted;
}

}  // namespace qmorph::cli
