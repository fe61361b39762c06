// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Curved surfaces that Gmsh has meshed so coarsely that the triangles are no picture of them: a tube with three edges
/// around, a torus that has become a flat strip. No quads on such triangles would be on the surface.

#include <map>
#include <vector>

namespace qmorph::adapter {

/// By the geometry.
bool is_curved(int surface);

/// Which of these surfaces, if they are curved, are that coarse: much of the area is of triangles that stand at far
/// more than a right angle to a neighbour, or it is another area altogether than the geometry's, where Gmsh knows that,
/// or there is no element at all.
/// \pre within run_logged()
std::vector<int> find_too_coarse(const std::vector<int>& surfaces);

/// Asks for twice as many segments as so far of the curves around these surfaces.
/// `times`: by curve, how many times as many as its size says it gets, 1 if it is not there.
/// \return false if nothing is left to ask for
bool ask_for_more(const std::vector<int>& surfaces, std::map<int, int>& times);

}  // namespace qmorph::adapter
