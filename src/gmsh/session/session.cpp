// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/session/session.hpp"

#include <stdlib.h>

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "gmsh/session/compat.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// Below 2 the log stays empty; 5 is the gmsh command's default.
constexpr double kVerbosity = 5;

constexpr std::size_t kErrorsToShow = 3;

bool take(const std::string& line, std::string_view prefix, std::vector<std::string>& into) {
  if (line.compare(0, prefix.size(), prefix) != 0) return false;
  into.push_back(line.substr(prefix.size()));
  return true;
}

std::string get_last_error() {
  std::string error;
  ::gmsh::logger::getLastError(error);
  return error;
}

/// Gmsh's window library makes a directory in the user's one when it starts, window or not. Where Gmsh has a place of
/// its own, it is to be there.
class HomeOfGmsh {
 public:
  HomeOfGmsh() {
    const char* home = std::getenv("HOME");
    const char* gmsh = std::getenv("GMSH_HOME");
    if (!home || !gmsh) return;
    before_ = home;
    ::setenv("HOME", gmsh, 1);
  }
  ~HomeOfGmsh() {
    if (before_) ::setenv("HOME", before_->c_str(), 1);
  }
  HomeOfGmsh(const HomeOfGmsh&) = delete;
  HomeOfGmsh& operator=(const HomeOfGmsh&) = delete;

 private:
  std::optional<std::string> before_;
};

}  // namespace

Session::Session(const std::vector<std::string>& arguments) : words_{"qmorph"} {
  words_.insert(words_.end(), arguments.begin(), arguments.end());
  for (std::string& word : words_) argv_.push_back(word.data());
  argv_.push_back(nullptr);
  const HomeOfGmsh home;
  // No configuration files: the same input and options give the same mesh for every user.
  ::gmsh::initialize(static_cast<int>(words_.size()), argv_.data(), false);
  complaint_ = get_last_error();
  take_control();
}

Session::~Session() {
  if (left_) return;
  try {
    ::gmsh::finalize();
  } catch (...) {  // a destructor cannot report it
  }
}

StageLog run_logged(const std::function<void()>& stage) {
  StageLog log;
  const std::string last_error = get_last_error();
  ::gmsh::logger::start();
  std::exception_ptr ours;
  try {
    stage();
  } catch (const Error&) {
    ours = std::current_exception();
  } catch (const std::string& error) {
    log.errors.push_back(error);
  } catch (const std::bad_alloc&) {
    log.errors.push_back("there is not enough memory for what it says");
  } catch (const std::exception& error) {
    log.errors.push_back(error.what());
  }
  std::vector<std::string> lines;
  ::gmsh::logger::get(lines);
  ::gmsh::logger::stop();
  if (ours) std::rethrow_exception(ours);
  for (const std::string& line : lines) {
    if (take(line, "Error: ", log.errors)) continue;
    if (take(line, "Warning: ", log.warnings)) continue;
    take(line, "Info: ", log.information);
  }
  // A script that turns the verbosity off turns the log off, too, but not this.
  const std::string error = get_last_error();
  if (log.errors.empty() && !error.empty() && error != last_error) log.errors.push_back(error);
  return log;
}

std::string first_errors(const StageLog& log) {
  if (log.errors.empty()) return "no reason given";
  std::vector<std::string> different;
  std::set<std::string_view> seen;
  for (const std::string& error : log.errors)
    if (seen.insert(error).second) different.push_back(error);
  std::string text;
  for (std::size_t i = 0; i < different.size() && i < kErrorsToShow; ++i) text += (i ? "; " : "") + different[i];
  if (different.size() > kErrorsToShow) text += " (and " + std::to_string(different.size() - kErrorsToShow) + " more)";
  return text;
}

QuietErrors::QuietErrors()
    : abort_on_error_(get_option("General.AbortOnError")), verbosity_(get_option("General.Verbosity")) {
  set_option("General.AbortOnError", 0);
  if (verbosity_ < 2) set_option("General.Verbosity", 2);
}

QuietErrors::~QuietErrors() {
  try {
    set_option("General.AbortOnError", abort_on_error_);
    set_option("General.Verbosity", verbosity_);
  } catch (...) {  // a destructor cannot report it
  }
}

double get_option(const std::string& name) {
  double value = 0;
  ::gmsh::option::getNumber(name, value);
  return value;
}

bool option_exists(const std::string& name) {
  double number = 0;
  std::string text;
  return run_logged([&] { ::gmsh::option::getNumber(name, number); }).errors.empty() ||
         run_logged([&] { ::gmsh::option::getString(name, text); }).errors.empty();
}

void set_option(const std::string& name, double value) { ::gmsh::option::setNumber(name, value); }

void take_control() {
  set_option("General.Terminal", 0);
  set_option("General.AbortOnError", 0);
  set_option("General.Verbosity", kVerbosity);
  set_option("General.NumThreads", 1);
  for (const char* name : {"Mesh.MaxNumThreads1D", "Mesh.MaxNumThreads2D"}) set_option(name, 1);
}

ScopedOption::ScopedOption(std::string name, double value) : name_(std::move(name)), before_(get_option(name_)) {
  set_option(name_, value);
}

ScopedOption::~ScopedOption() {
  try {
    set_option(name_, before_);
  } catch (...) {  // a destructor cannot report it
  }
}

}  // namespace qmorph::adapter
