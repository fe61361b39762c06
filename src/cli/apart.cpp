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

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <new>

#include "cli/run.hpp"
#include "cli/slate.hpp"
#include "cli/standard_streams.hpp"

namespace qmorph::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array kEndings = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

/// The signals that this process waits for are blocked, from before there is a child until there is none any more.
class Signals {
 public:
  Signals() {
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
  void restore() const { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }
  int wait() const {
    int signal = 0;
    while (::sigwait(&waited_for_, &signal) != 0) {
    }
    return signal;
  }

 private:
  sigset_t waited_for_{}, before_{};
};

/// Memory that a child shares.
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

/// A directory for the temporary files of one run, or none where there is no place for it.
class PrivateDirectory {
 public:
  PrivateDirectory() {
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    if (error) return;
    std::string pattern = (parent / "qmorph-XXXXXX").string();
    if (::mkdtemp(pattern.data())) path_ = pattern;
  }
  ~PrivateDirectory() { remove(); }
  PrivateDirectory(const PrivateDirectory&) = delete;
  PrivateDirectory& operator=(const PrivateDirectory&) = delete;
  void remove() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
    path_.clear();
  }
  const std::string& path() const { return path_; }
  std::string foreign_words() const { return path_ + "/said"; }

 private:
  std::string path_;
};

/// A file descriptor to write to.
class DescriptorBuffer : public std::streambuf {
 public:
  explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) {}

 protected:
  std::streamsize xsputn(const char* text, std::streamsize length) override {
    std::streamsize done = 0;
    while (done < length) {
      const ::ssize_t written = ::write(descriptor_, text + done, static_cast<std::size_t>(length - done));
      if (written < 0 && errno != EINTR) break;
      done += std::max<::ssize_t>(written, 0);
    }
    return done;
  }
  int_type overflow(int_type c) override {
    const char character = traits_type::to_char_type(c);
    return traits_type::eq_int_type(c, traits_type::eof()) || xsputn(&character, 1) == 1 ? traits_type::not_eof(c)
                                                                                         : traits_type::eof();
  }

 private:
  int descriptor_;
};

/// The child: never returns.
[[noreturn]] void work(const std::vector<std::string>& arguments, const PrivateDirectory& directory, Slate& slate) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would tidy up, nor know
#endif
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that is not allowed to grow becomes an error
  const Process process{.err_is_terminal = ::isatty(STDERR_FILENO) == 1, .slate = &slate};
  const int err = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (!directory.path().empty()) {
    ::setenv("TMPDIR", directory.path().c_str(), 1);
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

std::string read_words(const PrivateDirectory& directory) {
  std::ifstream in(directory.foreign_words(), std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
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
  return said.empty() ? ::strsignal(signal) : said;
}

/// Ends this process as the signal would have ended it.
[[noreturn]] void end_by(int signal, const Signals& signals) {
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  signals.restore();
  ::_exit(bad_input);  // not reached: the signal is delivered once it is not blocked
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
  const std::string words = directory.path().empty() ? "" : read_words(directory);
  directory.remove();
  if (WIFSIGNALED(status) && std::count(kEndings.begin(), kEndings.end(), WTERMSIG(status)))
    ended_by = WTERMSIG(status);  // the terminal's signal goes to both
  if (ended_by) end_by(ended_by, signals);
  signals.restore();
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

}  // namespace qmorph::cli
