// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The command, without the process around it, so that a test can call it.

#include <iosfwd>
#include <string>
#include <vector>

namespace qmorph::cli {

/// Part of the command's contract: scripts depend on these numbers.
enum ExitStatus : int {
  all_converted = 0,
  bad_usage = 1,
  bad_input = 2,
  converted_in_part = 3,
  no_surface = 4,
  cannot_write = 5,
  not_good_enough = 6,
};

class Slate;

/// What surrounds a run.
struct Process {
  bool err_is_terminal = false;
  /// Where it says what it does, for the process that waits; this one ends with the run. May be null.
  Slate* slate = nullptr;
};

/// Runs the command. Answers to --help, --version and --check go to `out`, and the mesh if that is asked for;
/// everything else to `err`. Throws nothing.
int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err, const Process& process = {});

}  // namespace qmorph::cli
