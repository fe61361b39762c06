#include "apart.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
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
  _exit(status);  // without taking Gmsh's model down, which nobody waits for
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
    be_child(task, ends[1]);
  }
  close(ends[1]);

  Ran ran;
  pollfd waiting{ends[0], POLLIN, 0};
  if (poll(&waiting, 1, int(std::min(1e9, 1e3 * limit))) == 0) {
    ran.end = End::over_limit;
    kill(child, SIGKILL);
  } else {
    const bool whole = read(ends[0], &ran.figures, sizeof ran.figures) == ssize_t(sizeof ran.figures);
    ran.end = whole ? End::finished : End::failed;
  }
  close(ends[0]);
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  ran.peak_bytes = 1024 * double(usage.ru_maxrss);
  return ran;
}

}  // namespace benchmark
