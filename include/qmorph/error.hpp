#pragma once
/// The one family of exceptions that the library throws. Each says what is wrong, where, and what to do;
/// none is thrown from inside the advancing front, where "this step is not possible here" is an answer.

#include <stdexcept>
#include <string>

namespace qmorph {

/// Base of every exception of this library. `what()` is one line that a user can act on.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The command line or an option makes no sense (exit status 1).
class UsageError : public Error {
 public:
  using Error::Error;
};

/// The input cannot be opened, read or meshed (exit status 2).
class InputError : public Error {
 public:
  using Error::Error;
};

/// One surface cannot be converted: it is not planar, overlaps itself, is not a manifold, has a NaN
/// coordinate, ... The message gives coordinates; the surface is left as it was (exit status 3).
class SurfaceError : public Error {
 public:
  using Error::Error;
};

/// The output cannot be written (exit status 5). A file of the same name is as it was before.
class OutputError : public Error {
 public:
  using Error::Error;
};

}  // namespace qmorph
