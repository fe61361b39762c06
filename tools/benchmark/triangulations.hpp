// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Triangulations of any size without a mesher: a jittered lattice of equilateral triangles with hexagonal holes, so
/// that a million triangles take a second and every machine gets the same bits.

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "qmorph/patch.hpp"

namespace benchmark {

using qmorph::Index;

enum class Kind {
  even,    ///< a square with 16 holes
  graded,  ///< the same under the conformal map exp(z), which keeps shapes while sizes vary by a factor of 100
  many,    ///< 100 squares with a hole each, which share their sides
};
inline constexpr Kind kKinds[] = {Kind::even, Kind::graded, Kind::many};

/// "even", "graded", "many surfaces"
const char* name_of(Kind kind);

/// Surfaces in the plane z = 0, all counterclockwise; where two of them share an edge, they use the same two points.
struct Triangulation {
  std::vector<Eigen::Vector3d> points;
  std::vector<bool> boundary;  ///< by point: whether it is on the boundary of a surface
  std::vector<std::vector<std::array<Index, 3>>> surfaces;

  std::size_t triangle_count() const;
  /// One of the surfaces.
  qmorph::Patch patch(std::size_t surface) const;
};

/// About `wanted` triangles in all; every surface has an even number of sides.
Triangulation make_triangulation(double wanted, Kind kind);

/// The holes of Kind::even in the unit square: centres and the radius of the circle around each hexagon.
inline constexpr int kHolesEachWay = 4;
inline constexpr double kHoleRadius = 0.06;

/// The triangles as MSH 2.2, for comparing with what other programs make of them; ends the process where that fails.
void write_msh2(const Triangulation& mesh, const std::string& path);

}  // namespace benchmark
