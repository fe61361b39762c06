// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Runs each measurement in a process of its own, so that peak memory is its own and it can be ended if it takes too long.

#include <cstddef>
#include <functional>

namespace benchmark {

/// Seconds of what a process did, as far as it got. Plain data, since it goes through a pipe.
struct Figures {
  std::size_t triangles = 0;  ///< of the input
  double open = 0,
         write = 0;  ///< CPU seconds: Gmsh's share, from a file of triangles to a model, and from the model to a file
  double cpu = 0;    ///< CPU seconds between the two, of all threads together
  double work = 0;   ///< the same, elapsed; what follows are its parts, for qmorph
  double read = 0, convert = 0, front = 0, cleanup = 0, smoothing = 0, check = 0, replace = 0;
};

enum class End { finished, over_limit, failed, not_tried };

struct Ran {
  End end = End::not_tried;
  Figures figures;        ///< of End::finished
  double peak_bytes = 0;  ///< resident memory
};

/// Runs `task` in a child process, which is ended after `limit` CPU seconds. What it throws goes to stderr.
/// \pre this process has one thread
Ran run_apart(const std::function<Figures()>& task, double limit);

}  // namespace benchmark
