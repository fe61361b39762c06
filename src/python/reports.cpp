// SPDX-License-Identifier: GPL-2.0-or-later
#include "python/reports.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "qmorph/error.hpp"

namespace py = pybind11;

namespace qmorph::python {
namespace {

std::string as_written(std::string name, char dot) {
  std::replace(name.begin(), name.end(), '.', dot);
  return name;
}

double number_from(const std::string& name, const py::handle& value) {
  try {
    return py::cast<double>(value);
  } catch (const py::cast_error&) {
    throw UsageError(name + ": a number is expected");
  }
}

SmoothingMethod method_from(const py::handle& value) {
  const std::string name = py::str(value);
  if (name == "shape_energy") return SmoothingMethod::shape_energy;
  if (name == "thesis") return SmoothingMethod::thesis;
  throw UsageError("smoothing: 'shape_energy' or 'thesis' is expected, not '" + name + "'");
}

}  // namespace

Options options_from(const py::dict& named) {
  Options options;
  const std::vector<std::string> names = option_names();
  for (const auto& [key, value] : named) {
    const std::string name = py::str(key);
    if (name == "smoothing") {
      options.smoothing.method = method_from(value);
    } else if (name == "threads") {
      const double count = number_from(name, value);
      if (!(count >= 0 && count <= 1e6) || count != std::floor(count))
        throw UsageError("threads: a whole number, 0 or more, is expected");
      options.threads = int(count);
    } else {
      const auto known = std::find_if(names.begin(), names.end(), [&](const std::string& one) {
        return one == name || as_written(one, '_') == name;
      });
      if (known == names.end())
        throw UsageError("there is no option '" + name + "'; help(qmorph) and qmorph.option_names() list them all");
      set_option(options, *known, number_from(name, value));
    }
  }
  return options;
}

py::dict dict_of(const Quality& q) {
  using namespace py::literals;
  return py::dict("quads"_a = q.quads, "triangles"_a = q.triangles, "inverted"_a = q.inverted,
                  "scaled_jacobian_min"_a = q.scaled_jacobian_min, "scaled_jacobian_p1"_a = q.scaled_jacobian_p1,
                  "scaled_jacobian_p5"_a = q.scaled_jacobian_p5, "scaled_jacobian_mean"_a = q.scaled_jacobian_mean,
                  "scaled_jacobian_below_03"_a = q.scaled_jacobian_below_03, "eta_min"_a = q.eta_min,
                  "eta_mean"_a = q.eta_mean, "thesis_min"_a = q.thesis_min, "thesis_mean"_a = q.thesis_mean,
                  "angle_min_deg"_a = q.angle_min_deg, "angle_max_deg"_a = q.angle_max_deg,
                  "interior_nodes"_a = q.interior_nodes, "irregular_nodes"_a = q.irregular_nodes,
                  "irregular_share"_a = q.irregular_share(), "valence"_a = q.valence,
                  "boundary_valence"_a = q.boundary_valence);
}

py::dict dict_of(const ConversionReport& r) {
  using namespace py::literals;
  return py::dict("regions"_a = r.regions, "odd_regions"_a = r.odd_regions, "worse_regions"_a = r.worse_regions,
                  "layer_quads"_a = r.layer_quads, "front_quads"_a = r.front_quads,
                  "leftover_triangles"_a = r.leftover_triangles, "budgets_spent"_a = r.budgets_spent,
                  "front_seconds"_a = r.front_seconds, "elimination_seconds"_a = r.elimination_seconds,
                  "cleanup_seconds"_a = r.cleanup_seconds, "smoothing_seconds"_a = r.smoothing_seconds);
}

}  // namespace qmorph::python
