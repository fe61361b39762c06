// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Interfaces between parts act as boundaries while the parts are worked on; no line of the surface has to lie there.

#include "chart/divide.hpp"
#include "chart/ground.hpp"
#include "chart/windows.hpp"

namespace qmorph::chart {

using Edge = std::pair<Index, Index>;  ///< nodes, lower first; lists of them are sorted

bool is_among(const std::vector<Edge>& edges, Index a, Index b);

/// By side of the mesh: whether it lies on one of these edges; and back.
std::vector<bool> sides_on(const SurfaceMesh& mesh, const std::vector<Edge>& edges);
std::vector<Edge> edges_on(const SurfaceMesh& mesh, const std::vector<bool>& sides);

/// Moves nodes of interfaces, and those around, so that the interfaces are smooth. Where that has made their edges
/// shorter than others, some of their nodes go. Creases stay; faces may get other numbers. Where triangles are
/// stretched, all that is by their metric.
void straighten(SurfaceMesh& mesh, const std::vector<Edge>& creases, std::vector<Edge>& interface, const Ground& ground,
                Budget& budget);

/// Splits edges between parts in two so that one part at most has an odd number of sides, interfaces rather than
/// creases. New edges are added to `interface` or `creases`, `division` and `opposite` are brought up to date. Marks
/// the parts that changed.
std::vector<char> make_parts_even(SurfaceMesh& mesh, std::vector<Index>& opposite, Division& division,
                                  std::vector<Edge>& creases, std::vector<Edge>& interface,
                                  const space::Background& background);

}  // namespace qmorph::chart
