// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The command in a process of its own.

#include <string>
#include <vector>

namespace qmorph::cli {

/// Runs the command in a child of this process, which waits. Where the child dies, because Gmsh crashes on a file or a
/// geometry, that is an exit status and one line; where somebody ends this process by INT, TERM, HUP or QUIT, the child
/// ends, too. No temporary file is left in either case. What libraries print on the standard streams is held back until
/// the outcome is known.
/// \pre there is one thread
/// \return the exit status; does not return where a signal ends it
int run_apart(const std::vector<std::string>& arguments);

}  // namespace qmorph::cli
