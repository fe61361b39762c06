// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Flat triangulations in z = 0, counter-clockwise, that hard inputs are made of.

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <vector>

#include "qmorph/patch.hpp"
#include "random.hpp"

namespace benchmark {

using Eigen::Vector2d;
using qmorph::Index;
using qmorph::Patch;

/// Rows of nodes from bottom to top, each from left to right; the strips between them are zipped up by the shorter edge.
Patch zip(const std::vector<std::vector<Vector2d>>& rows);

/// A row of equal edges from x = 0 to `width`.
std::vector<Vector2d> row(double y, double width, int edges);

/// Cells of side 1, all cut along the same diagonal.
Patch grid(int columns, int rows);

/// Equilateral triangles of side 1; inner nodes moved by up to `jitter`, each way.
Patch lattice(int columns, int rows, double jitter, Random& random);

/// Nearly the Delaunay triangulation of the points: good enough for points in general position.
Patch delaunay(const std::vector<Vector2d>& points);

/// Moves all points.
void map_points(Patch& patch, const std::function<Vector2d(const Vector2d&)>& to);

/// Keeps triangles chosen by the places of their centroids, and what they use.
void keep_triangles(Patch& patch, const std::function<bool(const Vector2d&)>& is_kept);

/// An edge between two triangles, and the nodes across from it; the first triangle runs from a to b.
struct InnerEdge {
  Index a, b, left, right, left_triangle, right_triangle;
};
std::vector<InnerEdge> inner_edges(const Patch& patch);

/// Nodes on no edge with one triangle only.
std::vector<Index> inner_nodes(const Patch& patch);

/// Turns a share of the inner edges, one after another, where that leaves two triangles that are no flatter than
/// `flattest` (height over longest side).
void turn_edges(Patch& patch, double share, double flattest, Random& random);

/// One patch for each number that `part_of` gives to triangles, with those points that it uses.
std::vector<Patch> split(const Patch& patch, const std::vector<Index>& part_of, Index parts);

}  // namespace benchmark
