// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How the cost of the engine grows with the number of triangles: no Gmsh, one thread.

#include <vector>

#include "triangulations.hpp"

namespace benchmark {

/// Converts each size of each kind `repeats` times and prints a line for the median: CPU seconds by stages, seconds and
/// bytes per triangle, quality. \return false if a result is not valid
bool time_engine(const std::vector<double>& sizes, const std::vector<Kind>& kinds, int repeats);

}  // namespace benchmark
