// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The one family of exceptions that the library throws. Each says what is wrong, where, and what to do, in a line for
/// people and in fields for programs; none is thrown from inside the advancing front, where "this step is not possible
/// here" is an answer.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "qmorph/export.hpp"

namespace qmorph {

enum class ErrorKind {
  usage,           ///< an option or an argument makes no sense
  no_such_entity,  ///< the model has no entity with that tag
  input,           ///< it cannot be opened, read or meshed, or contradicts itself
  output,          ///< it cannot be written
  cancelled,       ///< `Options::progress` said so
  // Why one surface cannot be converted:
  surface,        ///< none of the following
  not_finite,     ///< a coordinate is NaN, infinite, or too large to compute with
  no_area,        ///< its triangles have no area in sum: it is closed, folded or degenerate
  not_manifold,   ///< more than two elements meet at an edge, or they are not oriented alike
  overlap,        ///< it lies over itself
  bad_element,    ///< an element is turned over, has no area, uses a node twice, or one that does not exist
  element_type,   ///< elements that are neither triangles nor quads, or of several orders
  volume,         ///< elements of a volume stand on it
  periodic,       ///< the surface that it is periodic with stays as it is, or is not its image
  no_valid_mesh,  ///< no valid quads were found
};

/// What an error is about. In a Gmsh model the number is a tag; for the engine alone it is the row of a node in
/// `Patch::points`.
struct ErrorSubject {
  enum class Kind { node, element, curve, surface, volume };
  Kind kind = Kind::node;
  std::size_t number = 0;
};

struct ErrorDetails {
  ErrorKind kind = ErrorKind::surface;
  std::optional<Eigen::Vector3d> place{};  ///< in the model's unit
  std::optional<ErrorSubject> subject{};
};

/// Base of every exception of this library. `what()` is one line that a user can act on.
class QMORPH_API Error : public std::runtime_error {
 public:
  Error(const std::string& what, ErrorDetails details) : std::runtime_error(what), details_(std::move(details)) {}
  ErrorKind kind() const { return details_.kind; }
  const std::optional<Eigen::Vector3d>& place() const { return details_.place; }
  const std::optional<ErrorSubject>& subject() const { return details_.subject; }
  const ErrorDetails& details() const { return details_; }

 private:
  ErrorDetails details_;
};

/// An option or an argument makes no sense.
class QMORPH_API UsageError : public Error {
 public:
  explicit UsageError(const std::string& what, ErrorDetails details = {.kind = ErrorKind::usage})
      : Error(what, std::move(details)) {}
};

/// The input cannot be opened, read or meshed.
class QMORPH_API InputError : public Error {
 public:
  explicit InputError(const std::string& what, ErrorDetails details = {.kind = ErrorKind::input})
      : Error(what, std::move(details)) {}
};

/// One surface cannot be converted, and is left as it was.
class QMORPH_API SurfaceError : public Error {
 public:
  explicit SurfaceError(const std::string& what, ErrorDetails details = {.kind = ErrorKind::surface})
      : Error(what, std::move(details)) {}
};

/// The output cannot be written. A file of the same name is as it was before.
class QMORPH_API OutputError : public Error {
 public:
  explicit OutputError(const std::string& what, ErrorDetails details = {.kind = ErrorKind::output})
      : Error(what, std::move(details)) {}
};

/// `Options::progress` has ended the work. Nothing has changed.
class QMORPH_API Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled", {.kind = ErrorKind::cancelled}) {}
};

}  // namespace qmorph
