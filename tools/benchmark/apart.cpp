// SPDX-License-Identifier: GPL-2.0-or-later
#include "apart.hpp"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <type_traits>

namespace benchmark {
namespace {

static_assert(std::is_trivially_copyable_v<Figures>);

[[noreturn]] void be_child(const std::function<Figures()>& task, int pipe_end) {
  int status = 1;
  try {
    const Figures figures = task();
    if (write(pipe_end, &figures, sizeof figures) == ssize_t(sizeof figures)) status = 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench: %s\n", error.what());
  } catch (const std::string& error) {  // Gmsh before 4.10
    std::fprintf(stderr, "bench: %s\n", error.c_str());
  }
  _exit(status);  // without taking Gmsh's model down, which would only cost time
}

}  // namespace

Ran run_apart(const std::function<Figures()>& task, double limit) {
  int ends[2];
  if (pipe(ends) != 0) return {End::failed, {}, 0};
  std::fflush(nullptr);  // else the child would print it again
  const pid_t child = fork();
  if (child < 0) return {End::failed, {}, 0};
  if (child == 0) {
    close(ends[0]);
    const rlim_t seconds = rlim_t(std::ceil(limit));
    const rlimit processor{seconds, seconds + 1};
    setrlimit(RLIMIT_CPU, &processor);
    be_child(task, ends[1]);
  }
  close(ends[1]);

  Ran ran;
  const bool whole = read(ends[0], &ran.figures, sizeof ran.figures) == ssize_t(sizeof ran.figures);
  close(ends[0]);
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  const bool over_limit = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
  ran.end = whole ? End::finished : over_limit ? End::over_limit : End::failed;
  ran.peak_bytes = 1024 * double(usage.ru_maxrss);
  return ran;
}

}  // namespace benchmark
