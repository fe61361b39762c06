// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Signals that end the program, held back until it has tidied up.

#include <csignal>

namespace qmorph::cli {

/// INT, TERM, HUP and QUIT.
bool ends_programs(int signal);

/// Those, and the one that tells of a child's end, are blocked from here on. What the caller ignores stays ignored.
class Signals {
 public:
  Signals();
  void restore() const;
  /// \return the next of them
  int wait() const;
  /// Ends this process as the signal would have ended it.
  [[noreturn]] void end_by(int signal) const;

 private:
  sigset_t waited_for_{}, before_{};
};

}  // namespace qmorph::cli
