// SPDX-License-Identifier: GPL-2.0-or-later
#include <array>
#include <sstream>
#include <variant>

#include "qmorph/error.hpp"
#include "qmorph/options.hpp"

namespace qmorph {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Where the number of that name is stored.
using Field = std::variant<double*, int*, bool*, std::size_t*>;

struct Name {
  std::string_view name;
  double least, most;
  Field (*field)(Options&);
  double unit = 1;  ///< stored value = unit * what callers see
};

constexpr std::array kNames = {
    // Table 4.1 of the thesis.
    Name{"EPSILON1", 0, 180, [](Options& o) -> Field { return &o.front.seam_angle_many; }, kDegree},
    Name{"EPSILON2", 0, 180, [](Options& o) -> Field { return &o.front.seam_angle; }, kDegree},
    Name{"COINCTOL", 0, 1, [](Options& o) -> Field { return &o.smoothing.thesis.coincidence; }},
    Name{"MOVETOLERANCE", 0, 1, [](Options& o) -> Field { return &o.smoothing.thesis.move_tolerance; }},
    Name{"OBSTOL", -4, 1, [](Options& o) -> Field { return &o.smoothing.thesis.optimise_below; }},
    Name{"DELTAFACTOR", 1e-9, 0.1, [](Options& o) -> Field { return &o.smoothing.thesis.delta_factor; }},
    Name{"MYMIN", 0, 1, [](Options& o) -> Field { return &o.smoothing.thesis.least_quality; }},
    Name{"THETAMAX", 90, 360, [](Options& o) -> Field { return &o.smoothing.thesis.largest_angle; }, kDegree},
    Name{"TOL", 0, 1, [](Options& o) -> Field { return &o.smoothing.thesis.least_gain; }},
    Name{"GAMMA", 0, 1, [](Options& o) -> Field { return &o.smoothing.thesis.gamma; }},
    Name{"MAXITER", 0, 1000, [](Options& o) -> Field { return &o.smoothing.thesis.most_passes; }},
    // Our own.
    Name{"cleanup.chevron_angle", 90, 360, [](Options& o) -> Field { return &o.cleanup.chevron_angle; }, kDegree},
    Name{"cleanup.pattern_rounds", 0, 100, [](Options& o) -> Field { return &o.cleanup.pattern_rounds; }},
    Name{"cleanup.connectivity_cases", 0, 1, [](Options& o) -> Field { return &o.cleanup.connectivity_cases; }},
    Name{"cleanup.boundary_cases", 0, 1, [](Options& o) -> Field { return &o.cleanup.boundary_cases; }},
    Name{"cleanup.transition_cases", 0, 1, [](Options& o) -> Field { return &o.cleanup.transition_cases; }},
    Name{"cleanup.diamond_cases", 0, 1, [](Options& o) -> Field { return &o.cleanup.diamond_cases; }},
    Name{"cleanup.shape_cases", 0, 1, [](Options& o) -> Field { return &o.cleanup.shape_cases; }},
    Name{"cleanup.transition_angle", 0, 360, [](Options& o) -> Field { return &o.cleanup.transition_angle; }, kDegree},
    Name{"cleanup.shape_angle", 90, 360, [](Options& o) -> Field { return &o.cleanup.shape_angle; }, kDegree},
    Name{"crease_angle", 0, 180, [](Options& o) -> Field { return &o.crease_angle; }, kDegree},
    Name{"layers", 0, 1, [](Options& o) -> Field { return &o.layers; }},
    Name{"part_triangles", 0, 1e9, [](Options& o) -> Field { return &o.part_triangles; }},
    Name{"smoothing.iterations", 0, 1000, [](Options& o) -> Field { return &o.smoothing.iterations; }},
    Name{"smoothing.target_quality", 0, 1, [](Options& o) -> Field { return &o.smoothing.target_quality; }},
};

void store(double value, double& field) { field = value; }
void store(double value, int& field) { field = int(value); }
void store(double value, bool& field) { field = value != 0; }
void store(double value, std::size_t& field) { field = std::size_t(value); }

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

UsageError no_such_option(std::string_view name) {
  std::string all;
  for (const std::string& known : option_names()) all += (all.empty() ? "" : ", ") + known;
  return UsageError("there is no option '" + std::string(name) + "'; there are " + all);
}

}  // namespace

void set_option(Options& options, std::string_view name, double value) {
  for (const Name& row : kNames) {
    if (row.name != name) continue;
    if (!(value >= row.least && value <= row.most))
      throw UsageError(std::string(name) + ": " + number(value) + " is out of range, which is " + number(row.least) +
                       " to " + number(row.most));
    std::visit([&](auto* field) { store(value * row.unit, *field); }, row.field(options));
    return;
  }
  throw no_such_option(name);
}

double get_option(const Options& options, std::string_view name) {
  Options copy = options;
  for (const Name& row : kNames)
    if (row.name == name)
      return std::visit([&](auto* field) { return static_cast<double>(*field) / row.unit; }, row.field(copy));
  throw no_such_option(name);
}

std::vector<std::string> option_names() {
  std::vector<std::string> names;
  for (const Name& row : kNames) names.emplace_back(row.name);
  return names;
}

}  // namespace qmorph
