// SPDX-License-Identifier: GPL-2.0-or-later
#include "python/arrays.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "qmorph/error.hpp"

namespace py = pybind11;

namespace qmorph::python {
namespace {

constexpr auto kAnyLayout = py::array::c_style | py::array::forcecast;

[[noreturn]] void refuse(const char* name, const char* wanted) { throw UsageError(std::string(name) + ": " + wanted); }

/// Anything that NumPy can make an array of; empty for None.
py::array array_from(const py::object& object, const char* name) {
  if (object.is_none()) return py::array_t<double>(0);
  py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    refuse(name, "not an array of numbers");
  }
  return array;
}

using Numbers = py::array_t<std::int64_t, kAnyLayout>;

/// Integers. Fractions are refused, since NumPy would round them silently.
Numbers whole_numbers(const py::array& array, const char* name) {
  const char kind = array.dtype().kind();
  if (array.size() > 0 && kind != 'i' && kind != 'u') refuse(name, "node numbers must be integers");
  return Numbers(array);
}

Index node_from(std::int64_t number, const char* name) {
  if (number < 0 || number >= std::int64_t(kNone)) refuse(name, "node numbers count from 0");
  return Index(number);
}

/// Refuses constraints that are not edges of the mesh.
void refuse_constraints_across(const Patch& patch) {
  if (patch.constraints.empty()) return;
  std::set<std::pair<Index, Index>> edges;
  const auto add = [&](const auto& elements) {
    for (const auto& element : elements)
      for (std::size_t i = 0; i < element.size(); ++i)
        edges.insert(std::minmax(element[i], element[(i + 1) % element.size()]));
  };
  add(patch.triangles);
  add(patch.quads);
  for (const auto& [a, b] : patch.constraints)
    if (!edges.contains(std::minmax(a, b)))
      throw UsageError(
          "constraints: " + std::to_string(a) + " - " + std::to_string(b) + " is not an edge of any element",
          {.place = patch.points[a]});
}

}  // namespace

std::vector<Eigen::Vector3d> points_from(const py::object& object) {
  const py::array array = array_from(object, "points");
  if (array.ndim() != 2 || (array.shape(1) != 2 && array.shape(1) != 3))
    refuse("points", "two or three columns are expected");
  if (array.dtype().kind() == 'c' || array.dtype().kind() == 'O') refuse("points", "real numbers are expected");
  const py::array_t<double, kAnyLayout> numbers(array);
  const auto view = numbers.unchecked<2>();
  std::vector<Eigen::Vector3d> points(std::size_t(view.shape(0)));
  for (py::ssize_t i = 0; i < view.shape(0); ++i)
    points[std::size_t(i)] = {view(i, 0), view(i, 1), view.shape(1) == 3 ? view(i, 2) : 0};
  return points;
}

template <std::size_t N>
std::vector<std::array<Index, N>> elements_from(const py::object& object, const char* name) {
  const py::array array = array_from(object, name);
  if (array.size() == 0) return {};
  if (array.ndim() != 2 || array.shape(1) != py::ssize_t(N))
    refuse(name, (std::to_string(N) + " columns of node numbers are expected").c_str());
  const Numbers numbers = whole_numbers(array, name);
  const auto view = numbers.unchecked<2>();
  std::vector<std::array<Index, N>> elements(std::size_t(view.shape(0)));
  for (py::ssize_t i = 0; i < view.shape(0); ++i)
    for (std::size_t k = 0; k < N; ++k) elements[std::size_t(i)][k] = node_from(view(i, py::ssize_t(k)), name);
  return elements;
}
template std::vector<std::array<Index, 2>> elements_from<2>(const py::object&, const char*);
template std::vector<std::array<Index, 3>> elements_from<3>(const py::object&, const char*);
template std::vector<std::array<Index, 4>> elements_from<4>(const py::object&, const char*);

std::vector<Index> nodes_from(const py::object& object, const char* name) {
  const py::array array = array_from(object, name);
  if (array.size() == 0) return {};
  if (array.ndim() != 1) refuse(name, "one column of node numbers is expected");
  const Numbers numbers = whole_numbers(array, name);
  std::vector<Index> nodes;
  for (py::ssize_t i = 0; i < numbers.size(); ++i) nodes.push_back(node_from(numbers.at(i), name));
  return nodes;
}

Patch patch_from(const py::object& points, const py::object& triangles, const py::object& quads,
                 const py::object& constraints, const py::object& fixed) {
  Patch patch;
  patch.points = points_from(points);
  patch.triangles = elements_from<3>(triangles, "triangles");
  patch.quads = elements_from<4>(quads, "quads");
  patch.constraints = elements_from<2>(constraints, "constraints");
  patch.fixed = nodes_from(fixed, "fixed");
  // The engine would refuse these, too, but as an error of the surface that does not name the argument.
  const auto check = [&](Index v, const char* name) {
    if (v >= patch.points.size()) refuse(name, "a node number is too large for the number of points");
  };
  for (const auto& [a, b] : patch.constraints) check(a, "constraints"), check(b, "constraints");
  for (Index v : patch.fixed) check(v, "fixed");
  refuse_constraints_across(patch);
  return patch;
}

py::dict arrays_of(QuadMesh&& mesh, const std::vector<Eigen::Vector3d>& before) {
  // -1 for points that have moved: callers look up data of the input's points by this, which would be wrong for them.
  std::vector<std::int32_t> source(mesh.source.size(), -1);
  for (std::size_t i = 0; i < source.size(); ++i)
    if (mesh.source[i] != kNone && before[mesh.source[i]] == mesh.points[i]) source[i] = std::int32_t(mesh.source[i]);
  py::dict arrays;
  arrays["points"] = view_of<Eigen::Vector3d, double, 3>(std::move(mesh.points));
  arrays["quads"] = view_of<std::array<Index, 4>, Index, 4>(std::move(mesh.quads));
  arrays["triangles"] = view_of<std::array<Index, 3>, Index, 3>(std::move(mesh.triangles));
  arrays["source"] = view_of<std::int32_t, std::int32_t, 1>(std::move(source));
  return arrays;
}

}  // namespace qmorph::python
