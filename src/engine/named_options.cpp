// SPDX-License-Identifier: GPL-2.0-or-later
#include <array>

#include "qmorph/error.hpp"
#include "qmorph/options.hpp"

namespace qmorph {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Name {
  std::string_view name;
  double least, most;
  void (*set)(Options&, double);
};

constexpr std::array kNames = {
    // Table 4.1 of the thesis.
    Name{"EPSILON1", 0, 180, [](Options& o, double v) { o.front.seam_angle_many = v * kDegree; }},
    Name{"EPSILON2", 0, 180, [](Options& o, double v) { o.front.seam_angle = v * kDegree; }},
    Name{"COINCTOL", 0, 1, [](Options& o, double v) { o.smoothing.thesis.coincidence = v; }},
    Name{"MOVETOLERANCE", 0, 1, [](Options& o, double v) { o.smoothing.thesis.move_tolerance = v; }},
    Name{"OBSTOL", -4, 1, [](Options& o, double v) { o.smoothing.thesis.optimise_below = v; }},
    Name{"DELTAFACTOR", 1e-9, 0.1, [](Options& o, double v) { o.smoothing.thesis.delta_factor = v; }},
    Name{"MYMIN", 0, 1, [](Options& o, double v) { o.smoothing.thesis.least_quality = v; }},
    Name{"THETAMAX", 90, 360, [](Options& o, double v) { o.smoothing.thesis.largest_angle = v * kDegree; }},
    Name{"TOL", 0, 1, [](Options& o, double v) { o.smoothing.thesis.least_gain = v; }},
    Name{"GAMMA", 0, 1, [](Options& o, double v) { o.smoothing.thesis.gamma = v; }},
    Name{"MAXITER", 0, 1000, [](Options& o, double v) { o.smoothing.thesis.most_passes = int(v); }},
    // Our own.
    Name{"cleanup.chevron_angle", 90, 360, [](Options& o, double v) { o.cleanup.chevron_angle = v * kDegree; }},
    Name{"cleanup.pattern_rounds", 0, 100, [](Options& o, double v) { o.cleanup.pattern_rounds = int(v); }},
    Name{"cleanup.connectivity_cases", 0, 1, [](Options& o, double v) { o.cleanup.connectivity_cases = v != 0; }},
    Name{"cleanup.boundary_cases", 0, 1, [](Options& o, double v) { o.cleanup.boundary_cases = v != 0; }},
    Name{"cleanup.transition_cases", 0, 1, [](Options& o, double v) { o.cleanup.transition_cases = v != 0; }},
    Name{"cleanup.diamond_cases", 0, 1, [](Options& o, double v) { o.cleanup.diamond_cases = v != 0; }},
    Name{"cleanup.shape_cases", 0, 1, [](Options& o, double v) { o.cleanup.shape_cases = v != 0; }},
    Name{"cleanup.transition_angle", 0, 360, [](Options& o, double v) { o.cleanup.transition_angle = v * kDegree; }},
    Name{"cleanup.shape_angle", 90, 360, [](Options& o, double v) { o.cleanup.shape_angle = v * kDegree; }},
    Name{"crease_angle", 0, 180, [](Options& o, double v) { o.crease_angle = v * kDegree; }},
    Name{"layers", 0, 1, [](Options& o, double v) { o.layers = v != 0; }},
    Name{"part_triangles", 0, 1e9, [](Options& o, double v) { o.part_triangles = std::size_t(v); }},
    Name{"smoothing.iterations", 0, 1000, [](Options& o, double v) { o.smoothing.iterations = int(v); }},
    Name{"smoothing.target_quality", 0, 1, [](Options& o, double v) { o.smoothing.target_quality = v; }},
};

}  // namespace

void set_option(Options& options, std::string_view name, double value) {
  for (const Name& row : kNames) {
    if (row.name != name) continue;
    if (!(value >= row.least && value <= row.most))
      throw UsageError("--set " + std::string(name) + ": the value is out of range");
    return row.set(options, value);
  }
  throw UsageError("--set: there is no '" + std::string(name) + "'");
}

std::vector<std::string> option_names() {
  std::vector<std::string> names;
  for (const Name& row : kNames) names.emplace_back(row.name);
  return names;
}

}  // namespace qmorph
