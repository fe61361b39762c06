// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gmsh and qmorph on the same triangles, in the same run.

#include <string>
#include <vector>

#include "apart.hpp"
#include "triangulations.hpp"

namespace benchmark {

/// All that is measured with one triangulation. Blossom is not tried where it is bound to take too long.
struct Comparison {
  Kind kind = Kind::even;
  std::size_t triangles = 0;
  Ran meshing;    ///< Gmsh makes about as many triangles; only for Kind::even
  Ran converted;  ///< qmorph converts these, on one thread
  Ran simple, blossom, one_thread, two_threads;
  bool same_bytes = false;  ///< in the files that one thread and two made
};

/// CPU seconds for one thread, which other programs on the machine do not disturb; elapsed seconds for two.
double seconds(const Comparison& comparison, Ran Comparison::*which);

/// Runs and prints both tables (Markdown). \param limit CPU seconds for each measurement
std::vector<Comparison> compare_with_gmsh(const std::vector<double>& sizes, const std::vector<Kind>& kinds,
                                          double limit);

/// Plots seconds over triangles, both logarithmic, one panel for each kind; ends the process if it cannot be written.
void write_plot(const std::vector<Comparison>& comparisons, const std::string& path);

}  // namespace benchmark
