// SPDX-License-Identifier: GPL-2.0-or-later
#include "hard_table.hpp"

#include <cstdio>
#include <ctime>

#include "apart.hpp"
#include "hard_inputs.hpp"
#include "qmorph/convert.hpp"
#include "qmorph/quality.hpp"

namespace benchmark {
namespace {

std::size_t count_triangles(const std::vector<qmorph::Patch>& patches) {
  std::size_t count = 0;
  for (const qmorph::Patch& patch : patches) count += patch.triangles.size() + 2 * patch.quads.size();
  return count;
}

std::vector<qmorph::Patch> make(const HardInput& input, std::optional<double> triangles) {
  std::vector<qmorph::Patch> usual = input.make({});
  if (!triangles) return usual;
  return input.make({*triangles / double(count_triangles(usual))});
}

Figures convert(const HardInput& input, std::optional<double> triangles) {
  const std::vector<qmorph::Patch> patches = make(input, triangles);
  std::vector<const qmorph::Patch*> pointers;
  Figures figures;
  figures.triangles = count_triangles(patches);
  for (const qmorph::Patch& patch : patches) pointers.push_back(&patch);
  qmorph::Options options;
  options.threads = 1;
  const std::clock_t start = std::clock();
  const std::vector<qmorph::Outcome> outcomes = qmorph::convert_all(pointers, options);
  figures.cpu = double(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%-52s %8zu %8.3f %7.1f", input.name.c_str(), figures.triangles, figures.cpu,
              1e6 * figures.cpu / double(figures.triangles));
  qmorph::QualityAccumulator quality;
  std::size_t i = 0;
  std::size_t refused = 0;
  std::string reason;
  qmorph::ConversionReport report;
  for (const qmorph::Outcome& outcome : outcomes) {
    const qmorph::Patch& patch = patches[i++];
    if (!outcome.conversion) {
      ++refused, reason = outcome.error->what();
      continue;
    }
    report.add(outcome.conversion->report);
    quality.add(patch, outcome.conversion->mesh);
  }
  const qmorph::Quality q = quality.result();
  std::printf(" %8zu %6zu %7.4f %6.3f %6.2f %7.2f %7.2f %6.2f", q.quads, q.triangles, q.scaled_jacobian_min,
              q.scaled_jacobian_mean, report.front_seconds, report.elimination_seconds, report.cleanup_seconds,
              report.smoothing_seconds);
  if (q.inverted > 0) std::printf(" %zu inverted", q.inverted);
  if (refused > 0) std::printf(" %zu refused: %.90s", refused, reason.c_str());
  std::printf("\n");
  std::fflush(stdout);
  return figures;
}

}  // namespace

bool time_hard_inputs(const std::string& word, std::optional<double> triangles, double limit) {
  std::printf("%-52s %8s %8s %7s %8s %6s %7s %6s %6s %7s %7s %6s\n", "", "triangles", "seconds", "us/tri", "quads",
              "left", "SJ min", "mean", "front", "elimin.", "cleanup", "smooth");
  bool all_quick = true;
  for (const HardInput& input : hard_inputs()) {
    if (input.name.find(word) == std::string::npos) continue;
    const Ran ran = run_apart([&] { return convert(input, triangles); }, limit);
    if (ran.end != End::finished) {
      std::printf("%-52s %s\n", input.name.c_str(), ran.end == End::over_limit ? "over the limit" : "failed");
      std::fflush(stdout);
    }
    all_quick = all_quick && ran.end == End::finished &&
                1e6 * ran.figures.cpu <= kMostMicroseconds * double(ran.figures.triangles);
  }
  return all_quick;
}

}  // namespace benchmark
