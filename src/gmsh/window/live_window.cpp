// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/window/live_window.hpp"

#include <algorithm>
#include <sstream>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

constexpr const char* kAction = "ONELAB/Action";
constexpr const char* kButton = "ONELAB/Button";

/// In pixels: wide enough for our words beside their fields.
constexpr int kMenuWidth = 340, kGraphicsWidth = 1100, kGraphicsHeight = 720;

/// What selectEntities() returns.
constexpr int kGivenUp = 0, kSelected = 1, kUndone = 3, kEnded = 4;

/// Colour of the elements' sides, dark enough to stand out from light fills and from the background.
constexpr int kMeshLines[] = {60, 60, 70};

/// Hides all views for as long as this lives: Gmsh 4.8 crashes when a click hits one that is made of lists.
class HiddenViews {
 public:
  HiddenViews() {
    std::vector<int> all;
    ::gmsh::view::getTags(all);
    for (int tag : all)
      if (get_option(visible(tag)) != 0) hidden_.push_back(tag), set_option(visible(tag), 0);
  }
  ~HiddenViews() {
    try {
      std::vector<int> all;  // some may be gone by now
      ::gmsh::view::getTags(all);
      for (int tag : hidden_)
        if (std::count(all.begin(), all.end(), tag)) set_option(visible(tag), 1);
    } catch (...) {  // a destructor cannot report it
    }
  }
  HiddenViews(const HiddenViews&) = delete;
  HiddenViews& operator=(const HiddenViews&) = delete;

 private:
  static std::string visible(int tag) { return "View[" + std::to_string(::gmsh::view::getIndex(tag)) + "].Visible"; }

  std::vector<int> hidden_;
};

}  // namespace

LoadedState loaded_state() {
  LoadedState state;
  ::gmsh::model::getCurrent(state.model);
  ::gmsh::model::getFileName(state.file);
  state.nodes = get_option("Mesh.NbNodes");
  state.triangles = get_option("Mesh.NbTriangles");
  state.quads = get_option("Mesh.NbQuadrangles");
  return state;
}

void begin_drawing(const std::string& script) {
  ::gmsh::model::add("untitled");
  ::gmsh::model::setFileName(script);
}

void define_parameters(const std::string& json) { ::gmsh::onelab::set(json); }

bool has_parameter(const std::string& name) {
  std::string data;
  ::gmsh::onelab::get(data, name);
  return data.size() > 2;  // "" or "{}" where there is none
}

void remove_parameter(const std::string& name) { ::gmsh::onelab::clear(name); }

double number_parameter(const std::string& name, double otherwise) {
  std::vector<double> values;
  ::gmsh::onelab::getNumber(name, values);
  return values.empty() ? otherwise : values.front();
}

std::string text_parameter(const std::string& name) {
  std::vector<std::string> values;
  ::gmsh::onelab::getString(name, values);
  return values.empty() ? "" : values.front();
}

void set_parameter(const std::string& name, double value) { ::gmsh::onelab::setNumber(name, {value}); }
void set_parameter(const std::string& name, const std::string& value) { ::gmsh::onelab::setString(name, {value}); }

std::string other_parameters(const std::string& ours) {
  std::vector<std::string> names;
  ::gmsh::onelab::getNames(names);
  std::string text;
  for (const std::string& name : names) {
    const auto in = [&](const std::string& group) { return name.rfind(group, 0) == 0; };
    if (in(ours) || in("ONELAB") || in("0Modules") || in("Gmsh/")) continue;
    std::vector<double> numbers;
    ::gmsh::onelab::getNumber(name, numbers);
    text += name + '=' + text_parameter(name);
    for (double number : numbers) text += ' ' + std::to_string(number);
    text += '\n';
  }
  return text;
}

void set_button(const std::string& label, const std::string& action) {
  ::gmsh::onelab::setString(kButton, {label, action});
}

std::string take_action() {
  const std::string action = text_parameter(kAction);
  if (!action.empty()) ::gmsh::onelab::setString(kAction, {""});
  return action;
}

void ask_for(const std::string& action) { ::gmsh::onelab::setString(kAction, {action}); }

void log_line(const std::string& text, Severity severity) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    ::gmsh::logger::write(line, severity == Severity::warning ? "warning" : "info");
}

void set_mesh_look() {
  set_option("Mesh.SurfaceFaces", 0);
  set_option("Mesh.SurfaceEdges", 1);
  set_option("Mesh.ColorCarousel", 0);  // by kind of element
  for (const char* kind : {"Mesh.Triangles", "Mesh.Quadrangles"})
    ::gmsh::option::setColor(kind, kMeshLines[0], kMeshLines[1], kMeshLines[2]);
}

void mesh_has_changed() {
  // Gmsh keeps what it has drawn after a mesh is cleared and filled, until an option of the mesh gets another value.
  constexpr const char* kOption = "Mesh.SurfaceEdges";
  const double value = get_option(kOption);
  set_option(kOption, value == 0);
  set_option(kOption, value);
}

void show_curves(bool visible) { set_option("Geometry.Curves", visible ? 1 : 0); }

void show_surface(int tag, bool visible) { ::gmsh::model::setVisibility({{2, tag}}, visible ? 1 : 0); }

LiveWindow::LiveWindow() {
  // Gmsh must neither save files unasked nor mesh by itself when a parameter changes.
  set_option("Solver.AutoSaveDatabase", 0);
  set_option("Solver.AutoMesh", 0);
  set_option("General.MenuWidth", kMenuWidth);
  set_option("General.GraphicsWidth", kGraphicsWidth);
  set_option("General.GraphicsHeight", kGraphicsHeight);
  if (!run_logged([] { ::gmsh::fltk::initialize(); }).errors.empty() || !is_open())
    throw UsageError("--gui: this Gmsh was built without its window");
}

bool LiveWindow::is_open() const { return ::gmsh::fltk::isAvailable() > 0; }

// Gmsh's calls would reopen a window that the user has closed.

void LiveWindow::turn(double seconds) {
  if (is_open()) ::gmsh::fltk::wait(seconds);
}

void LiveWindow::refresh() {
  if (!is_open()) return;
  ::gmsh::fltk::update();
  ::gmsh::graphics::draw();
}

void LiveWindow::status(const std::string& text) {
  if (is_open()) ::gmsh::fltk::setStatusMessage(text);
}

std::vector<int> LiveWindow::pick_surfaces() {
  const ScopedOption drawn("Geometry.Surfaces", 1);  // each as a cross that can be clicked on
  const HiddenViews hidden;
  refresh();
  std::vector<int> tags;
  while (is_open()) {  // each call is one click
    ::gmsh::vectorpair picked;
    const int what = ::gmsh::fltk::selectEntities(picked, 2);
    if (what == kEnded) break;
    if (what == kGivenUp) return {};
    if (what == kUndone && !tags.empty()) tags.pop_back();
    for (const auto& [dim, tag] : picked) {
      if (dim != 2) continue;
      std::erase(tags, tag);
      if (what == kSelected) tags.push_back(tag);
    }
    ::gmsh::fltk::setStatusMessage("surfaces: " + std::to_string(tags.size()) + "; press e to finish, q to cancel");
  }
  std::sort(tags.begin(), tags.end());
  return tags;
}

}  // namespace qmorph::adapter
