// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Rings of edges to be filled: around a polygon, or around a block of a grid.

#include <numbers>
#include <vector>

#include "cleanup/filling.hpp"
#include "kernel/fixture.hpp"

namespace qmorph::test {

/// A regular polygon whose side i is cut into sides[i] edges, as a fan of triangles around the last node. Nodes 0, 1,
/// ... are its outline counter-clockwise, from the first corner on.
inline Mesh polygon(const std::vector<int>& sides) {
  const auto corner = [&](std::size_t i) {
    const double angle = 2 * std::numbers::pi * double(i) / double(sides.size());
    return Vec2(std::cos(angle), std::sin(angle));
  };
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (int k = 0; k < sides[i]; ++k) {
      const double t = double(k) / sides[i];
      points.push_back((1 - t) * corner(i) + t * corner(i + 1));
    }
  const auto n = Index(points.size());
  points.emplace_back(0, 0);
  Polygons faces;
  for (Index i = 0; i < n; ++i) faces.push_back({n, i, (i + 1) % n});
  return drawn(points, faces);
}

/// Half-edges from each of these nodes to the next, and from the last to the first.
inline std::vector<Index> ring_through(const Mesh& mesh, const std::vector<Index>& nodes) {
  std::vector<Index> ring;
  for (std::size_t i = 0; i < nodes.size(); ++i) ring.push_back(edge(mesh, nodes[i], nodes[(i + 1) % nodes.size()]));
  return ring;
}

/// Places of the corners of a ring with these sides.
inline std::vector<int> corners_of(const std::vector<int>& sides) {
  std::vector<int> corners;
  for (int at = 0; int side : sides) {
    corners.push_back(at);
    at += side;
  }
  return corners;
}

/// The polygon, filled.
inline Mesh filled_polygon(const std::vector<int>& sides) {
  Mesh mesh = polygon(sides);
  std::vector<Index> outline, faces, nodes;
  for (Index i = 0; i + 1 < mesh.vertex_slots(); ++i) outline.push_back(i);
  for (Index f = 0; f < mesh.face_slots(); ++f) faces.push_back(f);
  const auto filling = cleanup::filling_between(corners_of(sides), int(outline.size()));
  if (!filling || !cleanup::fill(mesh, ring_through(mesh, outline), faces, *filling, nodes))
    throw std::logic_error("no such filling");
  return mesh;
}

/// A grid with `columns` x `rows` cells whose block of `width` x `height` cells, `margin` cells inside, has another
/// filling, with corners at these places counter-clockwise from the block's lower left corner.
inline Mesh grid_with_block(Index columns, Index rows, Index margin, Index width, Index height,
                            const std::vector<int>& corners) {
  Mesh mesh = quad_grid(columns, rows);
  const auto node = [&](Index x, Index y) { return (margin + y) * (columns + 1) + margin + x; };
  std::vector<Index> outline, faces, nodes;
  for (Index x = 0; x < width; ++x) outline.push_back(node(x, 0));
  for (Index y = 0; y < height; ++y) outline.push_back(node(width, y));
  for (Index x = width; x > 0; --x) outline.push_back(node(x, height));
  for (Index y = height; y > 0; --y) outline.push_back(node(0, y));
  for (Index y = 0; y < height; ++y)
    for (Index x = 0; x < width; ++x) faces.push_back(mesh.face(edge(mesh, node(x, y), node(x + 1, y))));
  const auto filling = cleanup::filling_between(corners, int(outline.size()));
  if (!filling || !cleanup::fill(mesh, ring_through(mesh, outline), faces, *filling, nodes))
    throw std::logic_error("no such filling");
  return mesh;
}

}  // namespace qmorph::test
