// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/window/window.hpp"

#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <vector>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::adapter {
namespace {

constexpr int kNoWindow = 3;

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

/// In the child process. Never returns.
[[noreturn]] void run_window(const std::string& path) {
  const StageLog log = run_logged([&] {
    ::gmsh::clear();
    ::gmsh::open(path);
    set_option("Mesh.SurfaceFaces", 0);
    set_option("Mesh.SurfaceEdges", 1);
    std::vector<int> views;
    ::gmsh::view::getTags(views);
    for (std::size_t i = 1; i < views.size(); ++i)  // one figure at a time
      set_option("View[" + std::to_string(i) + "].Visible", 0);
    ::gmsh::fltk::run();
  });
  ::_exit(log.errors.empty() ? 0 : kNoWindow);
}

/// A function of the X library, which Gmsh's window brings along; null if this one does without it.
template <typename Function>
Function* find_x(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_DEFAULT, name));
}

}  // namespace

Display::Display() {
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))
    trouble_ = "there is no display to open a window on (DISPLAY is not set)";
  auto* const open = find_x<void*(const char*)>("XOpenDisplay");
  if (!is_set("DISPLAY") || !open) return;
  connection_ = open(nullptr);
  if (!connection_ && !is_set("WAYLAND_DISPLAY"))
    trouble_ = std::string("the display ") + std::getenv("DISPLAY") + " cannot be opened";
}

Display::~Display() {
  if (auto* const close = find_x<int(void*)>("XCloseDisplay"); close && connection_) close(connection_);
}

std::string show_in_window(const std::string& path) {
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))
    return "there is no display to open a window on (DISPLAY is not set); open " + path +
           " with gmsh where there is one";
  const ::pid_t child = ::fork();
  if (child < 0) return "no process can be started for the window";
  if (child == 0) run_window(path);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return "Gmsh's window could not be opened; open " + path + " with gmsh";
}

}  // namespace qmorph::adapter
