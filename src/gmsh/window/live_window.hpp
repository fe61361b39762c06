// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gmsh's window while a program of ours runs behind it: its parameters, its button, its log.

#include <string>
#include <vector>

namespace qmorph::adapter {

/// What Gmsh has loaded, cheap enough to be asked ten times a second.
struct LoadedState {
  std::string model, file;
  double nodes = 0, triangles = 0, quads = 0;
  bool operator==(const LoadedState&) const = default;
};

LoadedState loaded_state();

/// An empty model whose drawing goes to a script of that name, as soon as something is drawn.
void begin_drawing(const std::string& script);

/// Parameters in the tree on the left (ONELAB). Names are paths, as "qmorph/01Size factor": numbers before a word give
/// the order and are not shown.
void define_parameters(const std::string& json);
bool has_parameter(const std::string& name);
void remove_parameter(const std::string& name);
double number_parameter(const std::string& name, double otherwise);
std::string text_parameter(const std::string& name);
void set_parameter(const std::string& name, double value);
void set_parameter(const std::string& name, const std::string& value);

/// Names and values of all others: those that a script has defined.
std::string other_parameters(const std::string& ours);

/// What the button beside the gear says, and the action that a press is.
void set_button(const std::string& label, const std::string& action);

/// The action that has been asked for since the last call, or "". "check": a parameter has another value.
std::string take_action();

/// As if a button had been pressed.
void ask_for(const std::string& action);

enum class Severity { information, warning };

/// A line for the window's log; of several lines one each.
void log_line(const std::string& text, Severity severity = Severity::information);

/// The mesh of surfaces by its lines.
void set_mesh_look();
/// What is drawn next is the mesh as it is now.
void mesh_has_changed();
void show_curves(bool visible);
void show_surface(int tag, bool visible);

/// The window from construction on. \pre a Session and a Display. Only in the main thread.
class LiveWindow {
 public:
  /// \throws UsageError if this Gmsh was built without it
  LiveWindow();
  bool is_open() const;
  /// Handles what the user does, for at most so many seconds; without limit if negative, until something is done.
  void turn(double seconds);
  /// Shows parameters that have been set, and draws.
  void refresh();
  /// A line at the bottom.
  void status(const std::string& text);
  /// Surfaces that the user clicks on, by tag; empty if they give up. The window lives on meanwhile.
  std::vector<int> pick_surfaces();
};

}  // namespace qmorph::adapter
