// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gmsh/convert/replace.hpp"
#include "gmsh/geometry/shape.hpp"

namespace qmorph::adapter {

/// Which nodes may go.
enum class Onto { shape, nothing };

/// Brings the nodes that the engine has put on the triangles of a curved surface onto what these stand for, as far as
/// that spoils no element. With Onto::nothing all nodes stay, and only their parameters are found.
/// \pre the results are valid
void put_onto(const Shape& shape, Onto onto, ConvertedSurface& surface);

}  // namespace qmorph::adapter
