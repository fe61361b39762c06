// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gmsh's lifetime, its options and its way of reporting errors.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "qmorph/error.hpp"

namespace qmorph::adapter {

/// Gmsh from construction to destruction. One at a time.
class Session {
 public:
  /// \param arguments options in the spelling of the gmsh command ("-clmax", "0.1"), already known to be
  ///        right: Gmsh ends the process on an option that it does not know.
  explicit Session(const std::vector<std::string>& arguments = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  /// Gmsh is not ended: for a process that ends soon, and a model that cannot be taken down.
  void leave() { left_ = true; }
  /// What Gmsh said of the arguments (-option, -string) before anyone could listen; of several complaints the last, and
  /// in a process that has had a session before perhaps one of that.
  const std::string& complaint() const { return complaint_; }

 private:
  std::vector<std::string> words_;  ///< the arguments: Gmsh's window reads them when it opens
  std::vector<char*> argv_;
  std::string complaint_;
  bool left_ = false;
};

/// Gmsh has failed in a way after which it crashes when it is ended: `Session::leave`.
class BrokenModel : public InputError {
 public:
  using InputError::InputError;
};

/// What Gmsh said during one stage, without the "Error: " before it.
struct StageLog {
  std::vector<std::string> errors, warnings, information;
};

/// Runs a stage and collects what Gmsh says. An exception of Gmsh (a string before 4.10, std::exception
/// after) counts as an error of the log; exceptions of this library pass.
StageLog run_logged(const std::function<void()>& stage);

/// The errors of a log in one line; "no reason given" if there is none.
std::string first_errors(const StageLog& log);

/// For the time of its life Gmsh reports errors by its log and does not throw across its own frames, which would leave
/// it locked.
class QuietErrors {
 public:
  QuietErrors();
  ~QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  double abort_on_error_ = 0, verbosity_ = 0;
};

double get_option(const std::string& name);
/// True for numbers and texts. Gmsh says nothing when one that it does not have is set on the command line.
bool option_exists(const std::string& name);
void set_option(const std::string& name, double value);

/// Sets the options that this code relies on: no output of Gmsh's own, errors in the log and nowhere else, one thread
/// (the log is not protected before 4.14, and only with one is Gmsh's mesh always the same). To be called again after a
/// script has run, since a script may change all of them.
void take_control();

/// Sets a numeric option for as long as this object lives.
class ScopedOption {
 public:
  ScopedOption(std::string name, double value);
  ~ScopedOption();
  ScopedOption(const ScopedOption&) = delete;
  ScopedOption& operator=(const ScopedOption&) = delete;

 private:
  std::string name_;
  double before_;
};

}  // namespace qmorph::adapter
