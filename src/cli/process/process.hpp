// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "cli/process/slate.hpp"

namespace qmorph::cli {

/// What surrounds a run.
struct Process {
  bool err_is_terminal = false;
  /// Where it says what it does, for the process that waits; this one ends with the run. May be null.
  Slate* slate = nullptr;
  /// Where Gmsh puts what it would put beside the user's own files; empty if no place was made.
  std::string gmsh_home{};
};

}  // namespace qmorph::cli
