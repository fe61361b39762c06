// SPDX-License-Identifier: GPL-2.0-or-later
// Long runs over random domains.
//
//   qmorph_campaign FIRST LAST          converts the seeds FIRST to LAST: a line for each that fails, then the totals
//   qmorph_campaign --dump SEED PREFIX  writes PREFIX-in.msh and, if the conversion ends, PREFIX-out.msh
//   qmorph_campaign --shrink SEED PREFIX  the same for a smaller patch that fails in the same way
//
// Seeds from 1000000000 on are nasty domains (support/nasty.hpp), those from 2000000000 on surfaces
// (support/surfaces.hpp).
//
// The seeds run in a child process, so that one that crashes or hangs is reported like any other, and the rest goes on.
// Exit status 0 if nothing failed.
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>

#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"
#include "support/domains.hpp"
#include "support/dump.hpp"
#include "support/invariants.hpp"
#include "support/nasty.hpp"
#include "support/shrink.hpp"
#include "support/surfaces.hpp"

namespace {

using namespace qmorph;

/// Seeds from here on are those of nasty domains and of curved surfaces, numbered from 0 again.
constexpr std::uint64_t kNasty = 1000000000, kCurved = 2000000000;

test::Domain domain_of(std::uint64_t seed) {
  if (seed >= kCurved) return test::random_surface(seed - kCurved);
  return seed < kNasty ? test::random_domain(seed) : test::nasty_domain(seed - kNasty);
}

constexpr int kHangSeconds = 20;  // an ordinary domain takes milliseconds

/// What the child says about one seed; goes through a pipe as it is.
struct Report {
  std::uint64_t seed = 0;
  std::size_t triangles = 0, quads = 0, interior = 0, irregular = 0;
  double seconds = 0, sj_min = 1, sj_sum = 0;
  char kind[80] = "", problem[240] = "";
};

void copy(char* to, std::size_t size, const std::string& from) { std::snprintf(to, size, "%s", from.c_str()); }

Report run_seed(std::uint64_t seed) {
  const test::Domain domain = domain_of(seed);
  Report report;
  report.seed = seed;
  report.triangles = domain.patch.triangles.size();
  copy(report.kind, sizeof report.kind, domain.kind);
  const auto start = std::chrono::steady_clock::now();
  std::string problem;
  try {
    const QuadMesh mesh = convert(domain.patch).mesh;
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto broken = test::broken_invariants(domain.patch, mesh);
    if (!broken.empty()) problem = broken.front();
    if (broken.empty() || broken.front().rfind("malformed", 0) != 0) {
      const auto& p = domain.patch;
      const Quality q = seed >= kCurved ? measure(mesh)
                                        : measure(mesh, test::area_vector(p.points, p.triangles, p.quads).normalized());
      report.quads = q.quads;
      report.interior = q.interior_nodes;
      report.irregular = q.irregular_nodes;
      report.sj_min = q.scaled_jacobian_min;
      report.sj_sum = q.scaled_jacobian_mean * double(q.quads);
    }
  } catch (const std::exception& e) {
    problem = std::string("exception: ") + e.what();
  }
  copy(report.problem, sizeof report.problem, problem);
  return report;
}

/// A problem without its numbers and places, so that like ones are counted together.
std::string cause_of(const std::string& problem) {
  std::string cause;
  for (const char c : problem.substr(0, problem.find('('))) {
    const bool number = std::isdigit(static_cast<unsigned char>(c)) ||
                        (!cause.empty() && cause.back() == '#' && (c == '.' || c == 'e' || c == '-'));
    if (!number)
      cause += c;
    else if (cause.empty() || cause.back() != '#')
      cause += '#';
  }
  return cause;
}

/// Seconds of processor time that a process has used; the machine may be busy with others.
double seconds_used(pid_t process) {
  clockid_t clock;
  timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0;
  return double(used.tv_sec) + 1e-9 * double(used.tv_nsec);
}

/// Whether the child has something to say before it has used too much time.
bool reports_in_time(pid_t child, int end) {
  const double start = seconds_used(child);
  for (int waited = 0; waited < 20 * kHangSeconds; ++waited) {
    pollfd wait{end, POLLIN, 0};
    if (poll(&wait, 1, 1000) != 0) return true;
    if (seconds_used(child) - start > kHangSeconds) return false;
  }
  return false;
}

/// How often a cause occurred, and its smallest example.
struct Cause {
  std::size_t count = 0;
  std::uint64_t seed = 0;
  std::size_t triangles = 0;
};

/// Totals and the seeds that stand out.
struct Summary {
  std::size_t seeds = 0, failed = 0, triangles = 0, quads = 0, interior = 0, irregular = 0;
  std::map<std::string, Cause> causes;
  double seconds = 0, sj_sum = 0;
  Report worst, slowest;
  std::size_t under_01 = 0;

  void add(const Report& r) {
    ++seeds;
    triangles += r.triangles;
    quads += r.quads;
    interior += r.interior;
    irregular += r.irregular;
    seconds += r.seconds;
    sj_sum += r.sj_sum;
    under_01 += r.sj_min < 0.1;
    if (r.sj_min < worst.sj_min) worst = r;
    if (r.seconds > slowest.seconds) slowest = r;
    if (!r.problem[0]) return;
    ++failed;
    Cause& cause = causes[cause_of(r.problem)];
    if (++cause.count == 1 || r.triangles < cause.triangles) {
      cause.seed = r.seed;
      cause.triangles = r.triangles;
    }
    std::printf("seed %llu (%zu triangles, %s): %s\n", static_cast<unsigned long long>(r.seed), r.triangles, r.kind,
                r.problem);
    std::fflush(stdout);
  }

  void print() const {
    std::printf("%zu seeds, %zu failed\n", seeds, failed);
    for (const auto& [text, cause] : causes)
      std::printf("%6zu  %s (smallest: seed %llu, %zu triangles)\n", cause.count, text.c_str(),
                  static_cast<unsigned long long>(cause.seed), cause.triangles);
    std::printf(
        "%zu triangles to %zu quads, mean scaled Jacobian %.3f, irregular %.1f %%, %zu domains with an element "
        "under 0.1\n",
        triangles, quads, quads ? sj_sum / double(quads) : 1.0,
        interior ? 100.0 * double(irregular) / double(interior) : 0.0, under_01);
    std::printf("worst scaled Jacobian %.2e at seed %llu (%s)\n", worst.sj_min,
                static_cast<unsigned long long>(worst.seed), worst.kind);
    std::printf("%.1f us a triangle, slowest seed %llu (%zu triangles, %s): %.1f ms\n",
                triangles ? 1e6 * seconds / double(triangles) : 0.0, static_cast<unsigned long long>(slowest.seed),
                slowest.triangles, slowest.kind, 1e3 * slowest.seconds);
  }
};

/// Converts first, first + 1, ... in a child until it is through, dies or hangs. Returns the seed to go on with.
std::uint64_t run_child(std::uint64_t first, std::uint64_t last, Summary& summary) {
  int ends[2];
  if (pipe(ends) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) {
    for (std::uint64_t seed = first; seed <= last; ++seed) {
      const Report report = run_seed(seed);
      if (write(ends[1], &report, sizeof report) != ssize_t(sizeof report)) _exit(1);
    }
    _exit(0);
  }
  close(ends[1]);
  std::uint64_t next = first;
  std::string problem;
  while (next <= last && problem.empty()) {
    if (!reports_in_time(child, ends[0])) {
      kill(child, SIGKILL);
      problem = "hang: more than " + std::to_string(kHangSeconds) + " s";
      break;
    }
    Report report;
    std::size_t have = 0;
    while (have < sizeof report) {
      const ssize_t got = read(ends[0], reinterpret_cast<char*>(&report) + have, sizeof report - have);
      if (got <= 0) break;
      have += std::size_t(got);
    }
    if (have < sizeof report) {
      problem = "crash";
    } else {
      summary.add(report);
      ++next;
    }
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (problem.empty()) return next;
  if (problem == "crash" && WIFSIGNALED(status)) problem += ": signal " + std::to_string(WTERMSIG(status));
  const test::Domain domain = domain_of(next);
  Report report;
  report.seed = next;
  report.triangles = domain.patch.triangles.size();
  copy(report.kind, sizeof report.kind, domain.kind);
  copy(report.problem, sizeof report.problem, problem);
  summary.add(report);
  return next + 1;
}

/// The first thing that is wrong with the conversion of a patch; empty if all is well.
std::string problem_of(const Patch& patch) {
  try {
    const auto broken = test::broken_invariants(patch, convert(patch).mesh);
    return broken.empty() ? "" : broken.front();
  } catch (const std::exception& e) {
    return std::string("exception: ") + e.what();
  }
}

void dump_patch(const Patch& patch, const std::string& prefix) {
  test::dump(patch, prefix + "-in.msh");
  try {
    const QuadMesh mesh = convert(patch).mesh;
    test::dump(patch, mesh, prefix + "-out.msh");
    for (const std::string& line : test::broken_invariants(patch, mesh)) std::printf("%s\n", line.c_str());
  } catch (const std::exception& e) {
    std::printf("exception: %s\n", e.what());
  }
}

/// Writes the patch of a seed and what becomes of it.
int dump_seed(std::uint64_t seed, const std::string& prefix, bool shrink) {
  test::Domain domain = domain_of(seed);
  if (shrink) {
    const std::string cause = cause_of(problem_of(domain.patch));
    if (cause.empty()) {
      std::printf("seed %llu does not fail\n", static_cast<unsigned long long>(seed));
      return 1;
    }
    domain.patch = test::shrunk(domain.patch, [&](const Patch& less) { return cause_of(problem_of(less)) == cause; });
  }
  std::printf("seed %llu: %s, %zu triangles, %zu quads\n", static_cast<unsigned long long>(seed), domain.kind.c_str(),
              domain.patch.triangles.size(), domain.patch.quads.size());
  dump_patch(domain.patch, prefix);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string action = argc == 4 ? argv[1] : "";
  if (action == "--dump" || action == "--shrink")
    return dump_seed(std::strtoull(argv[2], nullptr, 10), argv[3], action == "--shrink");
  if (argc != 3) {
    std::fprintf(stderr, "usage: qmorph_campaign FIRST LAST | --dump SEED PREFIX | --shrink SEED PREFIX\n");
    return 2;
  }
  const std::uint64_t last = std::strtoull(argv[2], nullptr, 10);
  Summary summary;
  for (std::uint64_t next = std::strtoull(argv[1], nullptr, 10); next <= last;) next = run_child(next, last, summary);
  summary.print();
  return summary.failed ? 1 : 0;
}
