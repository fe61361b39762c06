// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine_alone.hpp"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"

namespace benchmark {
namespace {

/// A line of /proc/self/status in bytes: VmRSS, or VmHWM for the peak; 0 where there is no such file.
double memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name)) return 1024 * std::atof(line.c_str() + name.size() + 1);
  return 0;
}

struct Timing {
  double seconds;  // of CPU time, which other programs on the machine do not disturb
  double own;      // CPU time over elapsed time
  qmorph::ConversionReport report;
};

std::vector<qmorph::Patch> patches_of(const Triangulation& mesh) {
  std::vector<qmorph::Patch> patches;
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s) patches.push_back(mesh.patch(s));
  return patches;
}

/// Prints a line and returns seconds per triangle; a negative value for a mesh that is not valid.
double run(Kind kind, const std::vector<qmorph::Patch>& patches, int repeats) {
  std::vector<const qmorph::Patch*> pointers;
  std::size_t triangles = 0;
  for (const qmorph::Patch& patch : patches) {
    pointers.push_back(&patch);
    triangles += patch.triangles.size();
  }
  qmorph::Options options;
  options.threads = 1;
  std::vector<Timing> timings;
  std::vector<qmorph::Outcome> outcomes;
  double bytes = 0;  // at the peak, over what the process had before
  for (int i = 0; i < repeats; ++i) {
    outcomes = {};
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // forget the peak so far
    const double before = memory("VmRSS");
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();
    outcomes = qmorph::convert_all(pointers, options);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    bytes = std::max(bytes, memory("VmHWM") - before);
    const double seconds = double(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    Timing timing{seconds, seconds / elapsed.count(), {}};
    for (const qmorph::Outcome& outcome : outcomes) {
      if (!outcome.conversion) {
        std::fprintf(stderr, "bench: %s\n", outcome.error->what());
        return -1;
      }
      timing.report.add(outcome.conversion->report);
    }
    timings.push_back(std::move(timing));
  }
  std::sort(timings.begin(), timings.end(), [](const Timing& a, const Timing& b) { return a.seconds < b.seconds; });
  const Timing& t = timings[timings.size() / 2];

  qmorph::QualityAccumulator figures;
  std::size_t quads = 0, left = 0;
  for (const qmorph::Outcome& outcome : outcomes) {
    const qmorph::QuadMesh& mesh = outcome.conversion->mesh;
    figures.add(mesh.points, mesh.triangles, mesh.quads, Eigen::Vector3d::UnitZ());
    quads += mesh.quads.size();
    left += mesh.triangles.size();
  }
  const qmorph::Quality quality = figures.result();
  const double per_triangle = t.seconds / double(triangles);
  std::printf("%-13s %9zu %8.3f %8.3f %8.3f %8.3f %8.3f %8.2f %9zu %5zu %6.3f %6.3f %5.1f%% %7.0f\n", name_of(kind),
              triangles, t.seconds, t.own * t.report.front_seconds, t.own * t.report.elimination_seconds,
              t.own * t.report.cleanup_seconds, t.own * t.report.smoothing_seconds, 1e6 * per_triangle, quads, left,
              quality.scaled_jacobian_min, quality.scaled_jacobian_mean, 100 * quality.irregular_share(),
              bytes / double(triangles));
  std::fflush(stdout);
  if (quality.inverted != 0) {
    std::fprintf(stderr, "bench: %zu inverted elements\n", quality.inverted);
    return -1;
  }
  return per_triangle;
}

}  // namespace

bool time_engine(const std::vector<double>& sizes, const std::vector<Kind>& kinds, int repeats) {
  std::printf("%-13s %9s %8s %8s %8s %8s %8s %8s %9s %5s %6s %6s %6s %7s\n", "sizes", "triangles", "seconds", "front",
              "elimin.", "cleanup", "smooth", "us/tri", "quads", "left", "SJ min", "mean", "irreg.", "B/tri");
  bool valid = true;
  for (const Kind kind : kinds) {
    std::vector<double> cost;
    for (const double size : sizes) cost.push_back(run(kind, patches_of(make_triangulation(size, kind)), repeats));
    valid = valid && *std::min_element(cost.begin(), cost.end()) >= 0;
    if (cost.size() > 1)
      std::printf("%-13s cost per triangle, last over first: %.2f\n", name_of(kind), cost.back() / cost.front());
  }
  return valid;
}

}  // namespace benchmark
