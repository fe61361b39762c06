// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/process/standard_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <istream>
#include <sstream>
#include <vector>

#include "qmorph/error.hpp"

namespace qmorph::cli {
namespace {

/// So that temporary files are removed when the reader goes away.
class NoPipeSignal {
 public:
  NoPipeSignal() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~NoPipeSignal() {
    if (before_ != SIG_ERR) std::signal(SIGPIPE, before_);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  void (*before_)(int);
};

void flush() {
  std::cout.flush();
  std::fflush(stdout);
}

void copy(std::istream& in, std::ostream& out) {
  constexpr std::size_t kChunk = 1 << 16;
  const NoPipeSignal no_signal;
  std::vector<char> chunk(kChunk);
  errno = 0;
  while (out && in) {
    in.read(chunk.data(), kChunk);
    out.write(chunk.data(), in.gcount());
  }
  out.flush();
  if (!out) throw OutputError(fmt::format("cannot write the standard output: {}", std::strerror(errno ? errno : EIO)));
}

}  // namespace

void hold_standard_streams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

StdoutAsStderr::StdoutAsStderr() {
  flush();
  saved_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (saved_ >= 0) ::dup2(STDERR_FILENO, STDOUT_FILENO);
}

StdoutAsStderr::~StdoutAsStderr() {
  flush();
  if (saved_ < 0) return;
  ::dup2(saved_, STDOUT_FILENO);
  ::close(saved_);
}

void answer(const std::string& text, std::ostream& out) {
  std::istringstream in(text);
  copy(in, out);
}

void answer_with_file(const std::string& path, std::ostream& out) {
  std::ifstream in(path, std::ios::binary);
  copy(in, out);
}

}  // namespace qmorph::cli
