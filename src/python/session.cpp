// SPDX-License-Identifier: GPL-2.0-or-later
// qmorph._session: the model of the running Gmsh session. People call qmorph/gmsh.py.
#include <pybind11/stl.h>

#include <cstdint>

#include "python/errors.hpp"
#include "python/reports.hpp"
#include "python/waiting.hpp"
#include "qmorph/gmsh.hpp"

// As gmshc.h has it, which C++ cannot read in every version.
extern "C" void gmshInitialize(int argc, char** argv, int readConfigFiles, int* ierr);

namespace py = pybind11;
using namespace qmorph;

namespace {

const char* name_of(SurfaceOutcome outcome) {
  switch (outcome) {
    case SurfaceOutcome::converted:
      return "converted";
    case SurfaceOutcome::already_quads:
      return "already_quads";
    case SurfaceOutcome::left:
      return "left";
  }
  return "left";
}

py::dict dict_of(const SurfaceReport& s) {
  using namespace py::literals;
  return py::dict("tag"_a = s.tag, "name"_a = s.name, "outcome"_a = name_of(s.outcome), "reason"_a = s.reason,
                  "warnings"_a = s.warnings, "triangles_in"_a = s.triangles_in, "quads_in"_a = s.quads_in,
                  "triangles_out"_a = s.triangles_out, "quads_out"_a = s.quads_out,
                  "quality"_a = python::dict_of(s.quality), "report"_a = python::dict_of(s.conversion),
                  "image_of"_a = s.image_of, "seconds"_a = s.seconds);
}

py::dict dict_of(const ModelReport& model) {
  py::list surfaces;
  for (const SurfaceReport& surface : model.surfaces) surfaces.append(dict_of(surface));
  py::dict report;
  report["surfaces"] = surfaces;
  report["warnings"] = model.warnings;
  report["quality"] = python::dict_of(model.total);
  return report;
}

using Function = ModelReport (*)(const Options&, const std::vector<int>&);

py::dict run(Function function, const std::vector<int>& surfaces, const py::dict& options, const py::object& progress) {
  ModelReport report;
  python::work_while_waiting(python::options_from(options), progress,
                             [&](const Options& own) { report = function(own, surfaces); });
  return dict_of(report);
}

py::dict make_even(const std::vector<int>& surfaces, const std::vector<int>& keep_curves) {
  const EvenReport even = session::make_even(surfaces, keep_curves);
  py::list splits;
  for (const SplitEdge& split : even.splits) {
    py::dict one;
    one["curve"] = split.curve;
    one["surfaces"] = split.surfaces;
    one["where"] = py::make_tuple(split.where.x(), split.where.y(), split.where.z());
    splits.append(one);
  }
  py::dict report;
  report["odd_regions"] = even.odd_regions;
  report["splits"] = splits;
  report["odd_surfaces"] = even.odd_surfaces;
  return report;
}

}  // namespace

PYBIND11_MODULE(_session, module) {
  using namespace py::literals;
  python::register_errors();
  const auto add = [&](const char* name, Function function) {
    module.def(
        name,
        [function](const std::vector<int>& surfaces, const py::dict& options, const py::object& progress) {
          return run(function, surfaces, options, progress);
        },
        "surfaces"_a, "options"_a, "progress"_a);
  };
  add("recombine", session::recombine);
  add("improve_quads", session::improve_quads);
  module.def(
      "measure_surfaces", [](const std::vector<int>& surfaces) { return dict_of(session::measure_surfaces(surfaces)); },
      "surfaces"_a);
  module.def("make_even", make_even, "surfaces"_a, "keep_curves"_a);
  // Two Gmsh libraries in one process have separate sessions that know nothing of each other.
  module.def("address_of_gmsh", [] { return reinterpret_cast<std::uintptr_t>(&gmshInitialize); });
}
