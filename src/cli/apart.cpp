// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/apart.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <new>

#include "cli/process/descriptor_buffer.hpp"
#include "cli/process/private_directory.hpp"
#include "cli/process/signals.hpp"
#include "cli/process/slate.hpp"
#include "cli/process/standard_streams.hpp"
#include "cli/run.hpp"

namespace qmorph::cli {
namespace {

/// Memory shared with a child.
class SharedSlate {
 public:
  SharedSlate() {
    void* memory =
        ::mmap(nullptr, sizeof(Slate), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, /*no file*/ -1, 0);
    if (memory != MAP_FAILED) slate_ = ::new (memory) Slate;
  }
  ~SharedSlate() {
    if (slate_) ::munmap(slate_, sizeof(Slate));
  }
  SharedSlate(const SharedSlate&) = delete;
  SharedSlate& operator=(const SharedSlate&) = delete;
  Slate* get() const { return slate_; }

 private:
  Slate* slate_ = nullptr;
};

/// The child: never returns.
[[noreturn]] void work(const std::vector<std::string>& arguments, const PrivateDirectory& directory, Slate& slate) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would tidy up, nor know
#endif
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that is not allowed to grow becomes an error
  const Process process{
      .err_is_terminal = ::isatty(STDERR_FILENO) == 1, .slate = &slate, .gmsh_home = directory.path()};
  const int err = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (!directory.path().empty()) {
    ::setenv("TMPDIR", directory.path().c_str(), 1);
    ::setenv("GMSH_HOME", directory.path().c_str(), 1);  // what -string says goes through a file there
    const int said = ::open(directory.foreign_words().c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (said >= 0 && err >= 0) ::dup2(said, STDERR_FILENO);
  }
  DescriptorBuffer buffer(err >= 0 ? err : STDERR_FILENO);
  std::ostream messages(&buffer);
  const int status = run(arguments, std::cout, messages, process);
  std::cout.flush();
  slate.has_ended = true;
  ::_exit(status);
}

/// What a library said at last: often why it gave up.
std::string last_line(const std::string& words) {
  const std::size_t end = words.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return {};
  const std::size_t before = words.find_last_of('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return words.substr(begin, end + 1 - begin);
}

std::string describe_death(int signal, const std::string& words) {
  if (signal == SIGKILL) return "killed; is there not enough memory?";
  if (signal == SIGXCPU) return "it does not end, or the time that is allowed was up";
  const std::string said = last_line(words);
  if (said.find("std::bad_alloc") != std::string::npos) return "there is not enough memory";
  return said.empty() ? ::strsignal(signal) : said;
}

/// \return how the child has ended. A signal that ends this process ends the child first; it is put into `ended_by`.
int wait_for(::pid_t child, const Signals& signals, int& ended_by) {
  for (;;) {
    int status = 0;
    if (::waitpid(child, &status, WNOHANG) == child) return status;
    const int signal = signals.wait();
    if (signal == SIGCHLD) continue;
    ended_by = signal;
    ::kill(child, SIGKILL);  // it may ignore others while a script runs a command, and has nothing to tidy up
  }
}

/// Says how the child has ended, where it could not say so itself. \return the exit status
int tell_end(int status, const Slate& slate, const std::string& words) {
  if (WIFSIGNALED(status)) {
    std::cerr << fmt::format("qmorph: {} ({})\n", slate.trouble(), describe_death(WTERMSIG(status), words));
    return slate.status();
  }
  if (!slate.has_ended && WEXITSTATUS(status) == 0) {
    std::cerr << "qmorph: Gmsh ended the program (does the script say Exit?); nothing has been written\n";
    return bad_input;
  }
  if (!slate.has_ended || slate.shows_foreign_words) std::cerr << words;
  if (slate.has_ended) return WEXITSTATUS(status);
  std::cerr << fmt::format("qmorph: {} (it ended the program with status {})\n", slate.trouble(), WEXITSTATUS(status));
  return slate.status();
}

}  // namespace

int run_apart(const std::vector<std::string>& arguments) {
  hold_standard_streams();
  const Signals signals;
  const SharedSlate shared;
  PrivateDirectory directory;
  const ::pid_t child = shared.get() ? ::fork() : -1;
  if (child < 0) {  // no memory for a second process
    signals.restore();
    return run(arguments, std::cout, std::cerr);
  }
  Slate& slate = *shared.get();
  if (child == 0) {
    signals.restore();
    work(arguments, directory, slate);
  }
  int ended_by = 0;
  const int status = wait_for(child, signals, ended_by);
  slate.files.remove_files();
  const std::string words = directory.read_foreign_words();
  directory.remove();
  // The terminal's signal goes to both.
  if (WIFSIGNALED(status) && ends_programs(WTERMSIG(status))) ended_by = WTERMSIG(status);
  if (ended_by) signals.end_by(ended_by);
  signals.restore();
  return tell_end(status, slate, words);
}

}  // namespace qmorph::cli
