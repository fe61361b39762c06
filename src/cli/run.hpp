// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The command, without the process around it, so that a test can call it.

#include <iosfwd>
#include <string>
#include <vector>

#include "cli/exit_status.hpp"
#include "cli/process/process.hpp"

namespace qmorph::cli {

/// Runs the command. Answers to --help, --version and --check go to `out`, and the mesh if that is asked for;
/// everything else to `err`. Throws nothing.
int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err, const Process& process = {});

}  // namespace qmorph::cli
