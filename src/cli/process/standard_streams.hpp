// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The standard streams of the process: whose they are, and whether they took what was written.

#include <iosfwd>
#include <string>

namespace qmorph::cli {

/// Opens those that the caller has closed, so that no file of ours gets their number. Writing to the output then fails.
void hold_standard_streams();

/// OpenCASCADE prints on the standard output, which is ours. While this object lives, the standard output is the
/// standard error.
class StdoutAsStderr {
 public:
  StdoutAsStderr();
  ~StdoutAsStderr();
  StdoutAsStderr(const StdoutAsStderr&) = delete;
  StdoutAsStderr& operator=(const StdoutAsStderr&) = delete;

 private:
  int saved_ = -1;
};

/// Writes to the standard output. A reader that has gone away is an error and not a signal. \throws OutputError
void answer(const std::string& text, std::ostream& out);

/// The same with what is in a file. \throws OutputError
void answer_with_file(const std::string& path, std::ostream& out);

}  // namespace qmorph::cli
