// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What Gmsh's numbers for element types mean.

#include <cstddef>
#include <vector>

namespace qmorph::adapter {

/// Gmsh's numbers for the linear types.
inline constexpr int kLine2 = 1, kTriangle3 = 2, kQuad4 = 3, kPoint1 = 15;

struct ElementType {
  int type = 0, dim = 0, order = 0;
  std::size_t nodes = 0, corners = 0;
  std::vector<double> local;  ///< u, v of each node in the reference element, for surfaces
  /// No nodes inside although the order has room for some: "serendipity", as the quad with 8 nodes.
  bool incomplete() const { return nodes == corners * static_cast<std::size_t>(order); }
};

/// \pre Gmsh is initialised
ElementType element_type(int type);

/// Gmsh's number for a triangle (3 corners) or quad (4) of an order, or 0 if it has none.
int type_number(std::size_t corners, int order, bool incomplete);

/// Whether an entity of the current model has elements.
bool has_elements(int dim, int tag);

}  // namespace qmorph::adapter
