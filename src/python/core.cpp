// SPDX-License-Identifier: GPL-2.0-or-later
// qmorph._core: arrays in, arrays out. People call qmorph/__init__.py.
#include <pybind11/stl.h>

#include "python/arrays.hpp"
#include "python/errors.hpp"
#include "python/reports.hpp"
#include "python/waiting.hpp"
#include "qmorph/convert.hpp"
#include "space/triangle_tree.hpp"

namespace py = pybind11;
using namespace qmorph;

namespace {

using Function = Conversion (*)(const Patch&, const Options&);

/// A dictionary of arrays and figures.
py::dict run(Function function, const Patch& patch, const py::dict& options, const py::object& progress) {
  Conversion conversion;
  Quality quality;
  python::work_while_waiting(python::options_from(options), progress, [&](const Options& own) {
    conversion = function(patch, own);
    QualityAccumulator accumulator;
    accumulator.add(patch, conversion.mesh);
    quality = accumulator.result();
  });
  py::dict result = python::arrays_of(std::move(conversion.mesh), patch.points);
  result["report"] = python::dict_of(conversion.report);
  result["quality"] = python::dict_of(quality);
  return result;
}

py::dict convert_arrays(const py::object& points, const py::object& triangles, const py::object& quads,
                        const py::object& constraints, const py::object& fixed, const py::dict& options,
                        const py::object& progress) {
  return run(convert, python::patch_from(points, triangles, quads, constraints, fixed), options, progress);
}

py::dict improve_arrays(const py::object& points, const py::object& triangles, const py::object& quads,
                        const py::object& constraints, const py::object& fixed, const py::dict& options,
                        const py::object& progress) {
  return run(improve, python::patch_from(points, triangles, quads, constraints, fixed), options, progress);
}

py::dict measure_arrays(const py::object& points, const py::object& triangles, const py::object& quads) {
  const Patch patch = python::patch_from(points, triangles, quads, py::none(), py::none());
  const auto check = [&](const auto& elements) {
    for (const auto& element : elements)
      for (Index v : element)
        if (v >= patch.points.size()) throw UsageError("an element uses a node that does not exist");
  };
  check(patch.triangles);
  check(patch.quads);
  QualityAccumulator accumulator;
  accumulator.add(patch.points, patch.triangles, patch.quads);
  py::dict figures = python::dict_of(accumulator.result());
  const auto each = accumulator.scaled_jacobians();
  figures["scaled_jacobians"] = python::view_of<double, double, 1>(std::vector<double>(each.begin(), each.end()));
  return figures;
}

/// For each place the row of the triangle that it lies on or is nearest to; -1 if there are no triangles.
py::array locate_places(const py::object& places, const py::object& points, const py::object& triangles) {
  const std::vector<Eigen::Vector3d> all = python::points_from(points);
  const auto elements = python::elements_from<3>(triangles, "triangles");
  const space::TriangleTree tree(all, elements);
  std::vector<std::int64_t> found;
  for (const Eigen::Vector3d& place : python::points_from(places)) {
    const Index triangle = tree.closest(place).triangle;
    found.push_back(triangle == kNone ? -1 : std::int64_t(triangle));
  }
  return python::view_of<std::int64_t, std::int64_t, 1>(std::move(found));
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  using namespace py::literals;
  python::register_errors();
  const auto add = [&](const char* name, auto function) {
    module.def(name, function, "points"_a, "triangles"_a, "quads"_a, "constraints"_a, "fixed"_a, "options"_a,
               "progress"_a);
  };
  add("convert", convert_arrays);
  add("improve", improve_arrays);
  module.def("measure", measure_arrays, "points"_a, "triangles"_a, "quads"_a);
  module.def("locate", locate_places, "places"_a, "points"_a, "triangles"_a);
  module.def("option_names", option_names);
  module.attr("version") = QMORPH_VERSION;
}
