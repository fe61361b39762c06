// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gmsh and qmorph on the same triangles, in the same run.

#include <string>
#include <vector>

#include "apart.hpp"
#include "triangulations.hpp"

namespace benchmark {

/// All that is measured with one triangulation. Blossom is not tried where it must take too long.
struct Comparison {
  Kind kind = Kind::even;
  std::size_t triangles = 0;
  Ran meshing;    ///< Gmsh makes about so many triangles; of Kind::even alone
  Ran converted;  ///< these by qmorph, one thread
  Ran simple, blossom, one_thread, two_threads;
  bool same_bytes = false;  ///< of the files that one thread and two made
};

/// Of one thread, the processor's, which other programs on the machine do not disturb; of two, the clock's.
double seconds(const Comparison& comparison, Ran Comparison::*which);

/// Runs and prints both tables (Markdown). \param limit seconds of the processor for each measurement
std::vector<Comparison> compare_with_gmsh(const std::vector<double>& sizes, const std::vector<Kind>& kinds,
                                          double limit);

/// Seconds over triangles, logarithmic both ways, one panel for each kind; ends the process where it cannot be written.
void write_plot(const std::vector<Comparison>& comparisons, const std::string& path);

}  // namespace benchmark
