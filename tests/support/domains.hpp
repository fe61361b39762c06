// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Random domains for the engine, without Gmsh: every seed gives a valid patch, the same one everywhere.

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "qmorph/patch.hpp"
#include "support/rng.hpp"

namespace qmorph::test {

struct Domain {
  std::string kind;  ///< in words what was drawn and how it was spoilt
  Patch patch;
};

/// Between one and about 2500 triangles. Polygons with holes, sharp corners, thin gaps, strong grading, embedded lines
/// and points, pinched nodes, several materials, existing quads; jittered, flipped, tilted, scaled, turned over,
/// renumbered.
Domain random_domain(std::uint64_t seed);

/// What is wrong with a patch as an input: one line each, with coordinates. Empty for every random domain.
std::vector<std::string> broken_inputs(const Patch& patch);

/// The patch with its points mapped by p -> scale * (turn * p) + shift.
Patch moved(Patch patch, double scale, const Eigen::Matrix3d& turn, const Eigen::Vector3d& shift);

/// The patch with points, elements and constraints in another order, and elements that start at another corner.
Patch renumbered(const Patch& patch, Rng& rng);

/// The patch seen from behind.
Patch turned_over(Patch patch);

Eigen::Matrix3d random_rotation(Rng& rng);

}  // namespace qmorph::test
