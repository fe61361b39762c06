// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// NumPy arrays to patches, and results to NumPy arrays.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <utility>
#include <vector>

#include "qmorph/patch.hpp"

namespace qmorph::python {

/// Coordinates in two columns (z = 0) or three: anything that NumPy can turn into doubles.
/// \throws UsageError for another shape
std::vector<Eigen::Vector3d> points_from(const pybind11::object& array);

/// Rows of node numbers, counted from 0; None gives no rows. \throws UsageError for another shape, fractions, or a
/// number below 0
template <std::size_t N>
std::vector<std::array<Index, N>> elements_from(const pybind11::object& array, const char* name);
std::vector<Index> nodes_from(const pybind11::object& array, const char* name);

Patch patch_from(const pybind11::object& points, const pybind11::object& triangles, const pybind11::object& quads,
                 const pybind11::object& constraints, const pybind11::object& fixed);

/// An array that owns the vector: no number is copied.
template <class Row, class Number, int kColumns>
pybind11::array view_of(std::vector<Row>&& rows) {
  static_assert(sizeof(Row) == kColumns * sizeof(Number));
  auto* owned = new std::vector<Row>(std::move(rows));
  const pybind11::capsule owner(owned, [](void* p) { delete static_cast<std::vector<Row>*>(p); });
  const auto count = pybind11::ssize_t(owned->size());
  const auto* data = reinterpret_cast<const Number*>(owned->data());
  if constexpr (kColumns == 1) return pybind11::array_t<Number>({count}, data, owner);
  return pybind11::array_t<Number>({count, pybind11::ssize_t(kColumns)}, data, owner);
}

/// The mesh as arrays "points", "quads", "triangles" and "source". `before`: the input's points.
pybind11::dict arrays_of(QuadMesh&& mesh, const std::vector<Eigen::Vector3d>& before);

}  // namespace qmorph::python
