// SPDX-License-Identifier: GPL-2.0-or-later
#include "python/errors.hpp"

#include <pybind11/pybind11.h>

#include <string>

#include "qmorph/error.hpp"

namespace py = pybind11;

namespace qmorph::python {
namespace {

const char* name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return "usage";
    case ErrorKind::no_such_entity:
      return "no_such_entity";
    case ErrorKind::input:
      return "input";
    case ErrorKind::output:
      return "output";
    case ErrorKind::cancelled:
      return "cancelled";
    case ErrorKind::surface:
      return "surface";
    case ErrorKind::not_finite:
      return "not_finite";
    case ErrorKind::no_area:
      return "no_area";
    case ErrorKind::not_manifold:
      return "not_manifold";
    case ErrorKind::overlap:
      return "overlap";
    case ErrorKind::bad_element:
      return "bad_element";
    case ErrorKind::element_type:
      return "element_type";
    case ErrorKind::volume:
      return "volume";
    case ErrorKind::periodic:
      return "periodic";
    case ErrorKind::no_valid_mesh:
      return "no_valid_mesh";
  }
  return "surface";
}

const char* name_of(ErrorSubject::Kind kind) {
  switch (kind) {
    case ErrorSubject::Kind::node:
      return "node";
    case ErrorSubject::Kind::element:
      return "element";
    case ErrorSubject::Kind::curve:
      return "curve";
    case ErrorSubject::Kind::surface:
      return "surface";
    case ErrorSubject::Kind::volume:
      return "volume";
  }
  return "node";
}

void set_error(const char* type, const Error& error) {
  py::object place = py::none(), subject = py::none();
  if (const auto& p = error.place()) place = py::make_tuple(p->x(), p->y(), p->z());
  if (const auto& s = error.subject()) subject = py::make_tuple(name_of(s->kind), s->number);
  const py::object types = py::module_::import("qmorph.errors");
  const py::object exception = types.attr(type)(error.what(), name_of(error.kind()), place, subject);
  PyErr_SetObject(types.attr(type).ptr(), exception.ptr());
}

}  // namespace

void register_errors() {
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const UsageError& error) {
      set_error("UsageError", error);
    } catch (const InputError& error) {
      set_error("InputError", error);
    } catch (const SurfaceError& error) {
      set_error("SurfaceError", error);
    } catch (const Cancelled& error) {
      set_error("Cancelled", error);
    } catch (const Error& error) {
      set_error("Error", error);
    }
  });
}

}  // namespace qmorph::python
