// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The order of a model's elements.

#include <cstddef>
#include <string>
#include <vector>

namespace qmorph::adapter {

/// What came of raising the order.
struct RaisedModel {
  std::vector<std::string> warnings;  ///< of Gmsh
  std::vector<std::string> bent;      ///< surfaces whose curved edges turn an element over, and where
  std::size_t moved_sides = 0;        ///< sides of elements, so that none is turned over
};

/// The largest one of an element; 1 without any.
int order_of_surfaces();

/// Makes the mesh one of a lower order, if it is of a higher one. \throws InputError
void lower_model(int order);

/// Gives a linear model the order of Mesh.ElementOrder, with nodes on the geometry. Nothing happens to others.
/// \throws InputError
RaisedModel raise_model();

}  // namespace qmorph::adapter
