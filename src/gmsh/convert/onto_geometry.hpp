// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gmsh/convert/replace.hpp"
#include "gmsh/geometry/landing.hpp"

namespace qmorph::adapter {

/// Brings the nodes that the engine has put on the triangles of a curved surface onto what these stand for,
/// as far as that spoils no element, and finds their parameters.
/// \pre the results are valid
void put_onto(const Lander& lander, ConvertedSurface& surface);

/// Finds the parameters alone: all nodes stay.
void find_parameters(const Lander& lander, ConvertedSurface& surface);

}  // namespace qmorph::adapter
