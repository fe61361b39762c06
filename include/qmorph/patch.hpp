// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What goes into the engine and what comes out: arrays, no Gmsh, no half-edges.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph {

/// One surface, as its mesh is. All indices are rows of `points`; lengths are in the model's unit.
struct Patch {
  std::vector<Eigen::Vector3d> points;            ///< every node that an element of the surface uses
  std::vector<std::array<Index, 3>> triangles;    ///< consistently oriented, to be converted
  std::vector<std::array<Index, 4>> quads;        ///< already there; kept as they are
  std::vector<std::array<Index, 2>> constraints;  ///< edges to keep: line elements on or in the surface
  std::vector<Index> fixed;                       ///< nodes to keep in place, besides those of the
                                                  ///< boundary and of the constraints
  bool is_smooth = false;  ///< the surface that the triangles stand for has no creases: what is sharp are facets
};

/// The same surface in quads. Nodes that are fixed, on the boundary or on a constraint have the
/// coordinates of the input bit for bit.
struct QuadMesh {
  std::vector<Eigen::Vector3d> points;          ///< kept nodes of the input in its order, then new ones
  std::vector<Index> source;                    ///< row of `Patch::points`, or kNone for a new node
  std::vector<std::array<Index, 3>> triangles;  ///< at most one for each region with an odd boundary
  std::vector<std::array<Index, 4>> quads;      ///< `Patch::quads` first
};

}  // namespace qmorph
