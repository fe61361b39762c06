// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One call of the command, on its way through the functions that work on it.

#include <iosfwd>
#include <string>
#include <vector>

#include "cli/exit_status.hpp"
#include "cli/messages/error_stream.hpp"
#include "cli/process/process.hpp"
#include "cli/request/request.hpp"

namespace qmorph::cli {

struct Call {
  const Request& request;
  const std::vector<std::string>& arguments;
  std::ostream& out;
  ErrorStream& err;
  const Process& process;

  /// What to say if this process dies from here on.
  void begin(ExitStatus status, const std::string& trouble) const {
    if (process.slate) process.slate->begin(status, trouble);
  }
  adapter::TemporaryNames* names() const { return process.slate ? &process.slate->files : nullptr; }
  /// For what may be silenced with -v 0.
  void warn(const std::string& what) const {
    if (request.verbosity >= 1) err << "warning: " << what << '\n';
  }
};

}  // namespace qmorph::cli
