// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// --gui: Gmsh's window with a panel of ours.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "cli/gui/document.hpp"
#include "cli/gui/front_log.hpp"
#include "cli/gui/panel.hpp"
#include "cli/work/call.hpp"
#include "gmsh/window/live_window.hpp"
#include "gmsh/window/shown_views.hpp"
#include "qmorph/observer.hpp"
#include "report/stats.hpp"

namespace qmorph::cli {

class Gui {
 public:
  /// Opens the window on the command line's file. \pre there is a Display
  /// \throws Error
  Gui(const Call& call, adapter::Session& session);

  bool is_open() const { return window_.is_open(); }
  /// Handles what the user does for at most so many seconds (negative: until something is done), then what was asked
  /// for by that.
  void turn(double seconds);

  const Document& document() const { return document_; }
  const FrontPlayer* player() const { return player_ ? &*player_ : nullptr; }
  /// All that was said since the beginning, a line each.
  const std::vector<std::string>& said() const { return said_; }

 private:
  void act(const std::string& action);
  void do_action(const std::string& action);
  void choices_changed();

  /// \param watch who watches, asked once there is a mesh; may be empty
  bool convert(const std::function<Observer*()>& watch = {});
  void back();
  void pick();
  void step(const std::string& action);
  bool record();
  void save();
  bool may_write(const std::string& path);
  void write_report();
  void write_film();
  void compare();

  bool watches_front() const { return player_ && document_.shows_triangles(); }
  void leave_front();
  void show();
  void tell(const Converted& converted);
  void say(const std::string& text, adapter::Severity severity = adapter::Severity::information);
  report::RunFacts facts(const Request& request, const std::string& output) const;

  std::ostringstream messages_;  ///< of what the window shares with the command
  ErrorStream err_;
  const Call call_;
  Document document_;
  adapter::LiveWindow window_;
  adapter::ShownViews views_;
  Choices choices_;
  std::string parameters_;  ///< of the script
  std::optional<FrontPlayer> player_;
  std::vector<std::string> said_;
  std::map<std::string, bool> saved_;  ///< files of ours: whether they have the triangles that were converted
  std::string asked_;                  ///< the file that the next press on "Save" may write over
};

/// The window until it is closed. \return the exit status. \throws Error
int show_gui(const Call& call);

}  // namespace qmorph::cli
