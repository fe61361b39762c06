// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/process/signals.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>

#include "cli/exit_status.hpp"

namespace qmorph::cli {
namespace {

constexpr std::array kEndings = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

}  // namespace

bool ends_programs(int signal) { return std::count(kEndings.begin(), kEndings.end(), signal) > 0; }

Signals::Signals() {
  ::sigemptyset(&waited_for_);
  for (const int signal : kEndings) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) ::sigaddset(&waited_for_, signal);  // nohup, or a shell's background
  }
  ::sigaddset(&waited_for_, SIGCHLD);
  std::signal(SIGCHLD, SIG_DFL);  // whoever ignores it never learns how a child has ended
  ::sigprocmask(SIG_BLOCK, &waited_for_, &before_);
}

void Signals::restore() const { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }

int Signals::wait() const {
  int signal = 0;
  while (::sigwait(&waited_for_, &signal) != 0) {
  }
  return signal;
}

void Signals::end_by(int signal) const {
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  restore();
  ::_exit(bad_input);  // not reached: the signal is delivered once it is not blocked
}

}  // namespace qmorph::cli
