// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "chart/interfaces.hpp"

namespace qmorph::chart {

/// Mean length of the edges at each node; by the metric, if triangles are stretched.
std::vector<double> mean_edges(const SurfaceMesh& mesh, const Ground& ground);

/// Merges nodes of interfaces into their neighbours there, where edges are short, so that edges are as long on the
/// whole as those of the mesh were (`size`, by node): elements beside an interface would be smaller than others.
/// Triangles only. Faces may get other numbers. Returns the nodes that others have become.
std::vector<Index> thin_out(SurfaceMesh& mesh, const std::vector<double>& size, const std::vector<Edge>& creases,
                            std::vector<Edge>& interface, const Ground& ground, Budget& budget);

}  // namespace qmorph::chart
