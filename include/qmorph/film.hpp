#pragma once
/// How a front advanced, step by step, small enough to keep: about 100 bytes a quad.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph {

/// What a step of the front did (thesis 2.2.3, 2.2.4).
enum class FilmStep : std::uint8_t {
  quad,              ///< a quad on a base edge
  small_loop,        ///< what remained of the front, a loop of four or six edges, was closed
  seam,              ///< two front edges were sewn together
  transition_seam,   ///< two of very different length
  transition_split,  ///< a front edge much longer than its neighbour was split
  refinement,        ///< a front edge much longer than the input's edges ahead was split
};

/// Where a side edge of a quad came from.
enum class SideEdge : std::uint8_t {
  front,    ///< it was a front edge already
  existing, ///< an edge near the ideal direction
  swapped,  ///< a diagonal was turned
  split,    ///< the edge opposite was split
  halved,   ///< an edge to another part of the front, cut in two so that no odd loop is left
};

/// One region's front. A point (x, y) of the film is `origin + x * axis_u + y * axis_v` in the model.
///
/// `bytes` holds the steps one after another. Numbers are LEB128 (seven bits a byte, lowest first, the high bit says that
/// more follow); `s` marks signed ones, written as 2n or -2n - 1. "near" is the origin of the step's base edge:
///   u8 FilmStep
///   only of a quad: u8 SideEdge left + 8 * SideEdge right + 64 if a side edge met the front, number of swaps for the top edge
///   the base edge: its origin, s target - origin
///   count, then for each node that moved or is new: s node - the one before (near, for the first), s dx, s dy from where
///     it was last; from near, of a node never seen
///   count, then for each face that changed: s face - the one before (0 for the first), its number of corners (0: gone), for
///     each corner s node - near
///   count, then for each front edge that has a new level: s origin - near, s target - near, level
struct Film {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_u = Eigen::Vector3d::UnitX(), axis_v = Eigen::Vector3d::UnitY();
  double corner_angle = 0;  ///< an end of a front edge is a corner below it, in radians
  std::vector<std::array<std::int32_t, 2>> points;  ///< at the start
  std::vector<std::array<Index, 4>> faces;          ///< at the start; of a triangle the last is kNone, of no face the first
  std::size_t steps = 0;
  std::vector<std::uint8_t> bytes;
};

}  // namespace qmorph
