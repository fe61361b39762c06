// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One measurement in a process of its own: its peak memory is its own, and it can be ended when it takes too long.

#include <cstddef>
#include <functional>

namespace benchmark {

/// Seconds of what a process did, as far as it did it. Plain data, as it goes through a pipe.
struct Figures {
  std::size_t triangles = 0;  ///< that went in
  double open = 0,
         write = 0;  ///< of the processor: Gmsh's share, from a file of triangles to a model, from the model to a file
  double cpu = 0;    ///< of the processor, between the two, all threads together
  double work = 0;   ///< the same, by the clock; the rest is of it, for qmorph
  double read = 0, convert = 0, front = 0, cleanup = 0, smoothing = 0, check = 0, replace = 0;
};

enum class End { finished, over_limit, failed, not_tried };

struct Ran {
  End end = End::not_tried;
  Figures figures;        ///< of End::finished
  double peak_bytes = 0;  ///< resident memory
};

/// Runs `task` in a child process; one that takes more than `limit` seconds of the processor is ended. What it throws
/// goes to stderr.
/// \pre this process has one thread
Ran run_apart(const std::function<Figures()>& task, double limit);

}  // namespace benchmark
