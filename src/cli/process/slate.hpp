// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the process that works leaves to the one that waits for it, in memory that both have.

#include <array>
#include <string_view>

#include "cli/exit_status.hpp"
#include "gmsh/write/temporary_names.hpp"

namespace qmorph::cli {

class Slate {
 public:
  /// What is to be said if the process dies from here on, why follows in brackets, and the exit status then.
  void begin(ExitStatus status, std::string_view trouble);
  std::string_view trouble() const { return trouble_.data(); }
  ExitStatus status() const { return status_; }

  adapter::TemporaryNames files;
  bool has_ended = false;            ///< the command has run to its end
  bool shows_foreign_words = false;  ///< what libraries have said is worth telling

 private:
  std::array<char, 1024> trouble_{};
  ExitStatus status_ = bad_input;
};

}  // namespace qmorph::cli
