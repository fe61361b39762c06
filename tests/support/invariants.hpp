// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The invariants I1 to I6 of src/README.md for one surface, checked without a line of the engine.

#include <string>
#include <vector>

#include "qmorph/patch.hpp"

namespace qmorph::test {

/// What of I1 to I6 does not hold: "rule: where", empty if all is well. The rules, with which lines begin:
///
///   malformed    arrays that do not fit, numbers out of range, coordinates that are not finite
///   source       not: kept nodes of the input in its order, then new ones
///   fixed node   one of the boundary, of a constraint, of a kept quad, or fixed, is gone or not the same bits (I1, I2)
///   boundary     not the same edges in the same direction                                                     (I1)
///   constraint   not an edge of the result                                                                    (I2)
///   kept quad    `Patch::quads` do not come first, as they were
///   conformity   an edge with three elements or two on one side; a node or element twice; an unused node      (I3)
///   orientation  a corner that is not strictly convex, seen along the input's normal                          (I4)
///   parity       more than one triangle in a region, or one in an even region                                 (I5)
///   area         not the input's to 1e-9; a node further off the plane than the input's are                   (I6)
///   surface      of a curved patch, instead of orientation and area: a node off the triangles; a corner that is turned
///                over, by their normals near it and by the element's mean normal; another Euler characteristic
std::vector<std::string> broken_invariants(const Patch& in, const QuadMesh& out);

/// Regions (triangles joined through edges that are not constraints), and how many have an odd number of boundary
/// sides.
struct RegionCount {
  std::size_t regions = 0, odd = 0;
};
RegionCount count_regions(const Patch& patch);

/// Twice the vector area of the elements.
Eigen::Vector3d area_vector(const std::vector<Eigen::Vector3d>& points,
                            const std::vector<std::array<Index, 3>>& triangles,
                            const std::vector<std::array<Index, 4>>& quads);

}  // namespace qmorph::test
