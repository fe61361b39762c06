#pragma once
/// What goes into the engine and what comes out: arrays, no Gmsh, no half-edges.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace qmorph {

using Index = std::uint32_t;
inline constexpr Index kNone = std::numeric_limits<Index>::max();

/// One surface, as its mesh is. All indices are rows of `points`; lengths are in the model's unit.
struct Patch {
  std::vector<Eigen::Vector3d> points;             ///< every node that an element of the surface uses
  std::vector<std::array<Index, 3>> triangles;     ///< consistently oriented, to be converted
  std::vector<std::array<Index, 4>> quads;         ///< already there; kept as they are
  std::vector<std::array<Index, 2>> constraints;   ///< edges to keep: line elements on or in the surface
  std::vector<Index> fixed;                        ///< nodes to keep in place, besides those of the
                                                   ///< boundary and of the constraints
};

/// Counts and warnings of one conversion.
struct ConversionStats {
  std::size_t regions = 0;            ///< sets of triangles joined through edges that are no constraints
  std::size_t odd_regions = 0;        ///< regions with an odd number of boundary sides: one triangle stays in each
  std::size_t front_quads = 0;        ///< quads that the advancing front made
  std::size_t leftover_triangles = 0; ///< triangles that the front left to triangle elimination
  double front_seconds = 0;
  double elimination_seconds = 0;
  double cleanup_seconds = 0;
  double smoothing_seconds = 0;
};

/// The same surface in quads. Nodes that are fixed, on the boundary or on a constraint have the
/// coordinates of the input bit for bit.
struct QuadMesh {
  std::vector<Eigen::Vector3d> points;          ///< kept nodes of the input in its order, then new ones
  std::vector<Index> source;                    ///< row of `Patch::points`, or kNone for a new node
  std::vector<std::array<Index, 3>> triangles;  ///< at most one for each region with an odd boundary
  std::vector<std::array<Index, 4>> quads;      ///< `Patch::quads` first
  ConversionStats stats;
};

}  // namespace qmorph
