// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Curved surfaces of triangles for tests.

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "qmorph/patch.hpp"
#include "support/halves.hpp"
#include "support/rng.hpp"

namespace qmorph::test {

/// Triangles over a grid of `across` by `along` cells of the unit square, as `place` puts them into space; nodes inside
/// are moved by up to `jitter` cells. Where `closed` says so, the last column (row) is the first one.
struct GridSurface {
  Index across = 10, along = 10;
  double jitter = 0;
  bool closed_across = false, closed_along = false;
};

inline Patch triangulated(const GridSurface& grid, const std::function<Eigen::Vector3d(double, double)>& place,
                          std::uint64_t seed = 1) {
  Patch patch;
  Rng rng(seed);
  const Index columns = grid.across + !grid.closed_across, rows = grid.along + !grid.closed_along;
  const auto move = [&](Index i, Index cells, bool closed) {
    return !closed && (i == 0 || i == cells) ? 0.0 : grid.jitter * rng.between(-1, 1);
  };
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const double u = (i + move(i, grid.across, grid.closed_across)) / grid.across;
      const double v = (j + move(j, grid.along, grid.closed_along)) / grid.along;
      patch.points.push_back(place(u, v));
    }
  const auto node = [&](Index i, Index j) { return j % rows * columns + i % columns; };
  for (Index j = 0; j < grid.along; ++j)
    for (Index i = 0; i < grid.across; ++i) {
      const std::array quad{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      add_halves(patch, quad, rng.chance(0.5));
    }
  return patch;
}

/// Radius 1 and length 1 about the z-axis, `turn` of the whole round; normals point outwards.
inline Patch cylinder(GridSurface grid, double turn = 1) {
  grid.closed_across = turn == 1;
  return triangulated(grid, [&](double u, double v) {
    const double angle = 2 * std::numbers::pi * turn * u;
    return Eigen::Vector3d(std::cos(angle), std::sin(angle), v);
  });
}

/// Radii 3 and 1 about the z-axis, closed; normals point outwards.
inline Patch torus(GridSurface grid) {
  grid.closed_across = grid.closed_along = true;
  return triangulated(grid, [](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v, r = 3 + std::cos(b);
    return Eigen::Vector3d(r * std::cos(a), r * std::sin(a), std::sin(b));
  });
}

}  // namespace qmorph::test
