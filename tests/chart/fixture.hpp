// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <doctest/doctest.h>

#include <numeric>

#include "chart/curved_region.hpp"
#include "chart/divide.hpp"
#include "support/surfaces.hpp"

namespace qmorph::test {

constexpr double kPlenty = 1e12;  ///< of work

/// A region of a patch, and its mesh before anything is done to it.
struct Start {
  chart::CurvedRegion region;
  chart::SurfaceMesh mesh;
  std::vector<Index> opposite;

  explicit Start(const Patch& patch, double crease_angle = std::numbers::pi)
      : region(std::move(chart::curved_regions(patch, crease_angle).at(0))),
        mesh(region.start()),
        opposite(chart::opposite_sides(mesh)) {}

  std::vector<Index> all() const {
    std::vector<Index> faces(mesh.faces.size());
    std::iota(faces.begin(), faces.end(), 0);
    return faces;
  }
  chart::Piece whole() const { return {mesh, opposite, {}, all()}; }
};

/// A grid in the plane, `columns` x `rows` squares of side 1, each in two triangles.
inline Patch plate(int columns, int rows) {
  Patch patch;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) patch.points.emplace_back(i, j, 0);
  const auto node = [&](int i, int j) { return Index(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      patch.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      patch.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return patch;
}

}  // namespace qmorph::test
