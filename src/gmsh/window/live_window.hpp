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

/// Starts an empty model. Once something is drawn in it, Gmsh writes it to a script of that name.
void begin_drawing(const std::string& script);

/// Parameters in the tree on the left (ONELAB). Names are paths, such as "qmorph/01Size factor"; the numbers give the
/// order and are not shown.
void define_parameters(const std::string& json);
bool has_parameter(const std::string& name);
void remove_parameter(const std::string& name);
double number_parameter(const std::string& name, double otherwise);
std::string text_parameter(const std::string& name);
void set_parameter(const std::string& name, double value);
void set_parameter(const std::string& name, const std::string& value);

/// Names and values of all parameters but ours: those that a script has defined.
std::string other_parameters(const std::string& ours);

/// What the button beside the gear says, and the action that pressing it asks for.
void set_button(const std::string& label, const std::string& action);

/// The action that has been asked for since the last call, or "". "check": a parameter has changed.
std::string take_action();

/// Asks for an action as if its button had been pressed.
void ask_for(const std::string& action);

enum class Severity { information, warning };

/// Adds to the window's log, one entry for each line of the text.
void log_line(const std::string& text, Severity severity = Severity::information);

/// Draws the meshes of surfaces as lines.
void set_mesh_look();
/// Makes Gmsh draw the mesh as it is now, not as it was.
void mesh_has_changed();
void show_curves(bool visible);
void show_surface(int tag, bool visible);

/// The window, open from construction on. \pre a Session and a Display. Only in the main thread.
class LiveWindow {
 public:
  /// \throws UsageError if this Gmsh was built without a window
  LiveWindow();
  bool is_open() const;
  /// Handles what the user does, for at most this many seconds; if negative, until the user does something.
  void turn(double seconds);
  /// Shows parameters that have been set, and draws.
  void refresh();
  /// A line at the bottom.
  void status(const std::string& text);
  /// The tags of the surfaces that the user clicks on, none if they cancel. The window stays alive meanwhile.
  std::vector<int> pick_surfaces();
};

}  // namespace qmorph::adapter
