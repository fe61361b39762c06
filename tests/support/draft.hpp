// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A test domain in the making: flat, in the plane, with the neighbourhoods that the spoilers need.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "qmorph/patch.hpp"

namespace qmorph::test {

struct Draft {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<Index, 3>> triangles;  ///< counter-clockwise
  std::vector<std::array<Index, 4>> quads;      ///< counter-clockwise
  std::vector<std::array<Index, 2>> constraints;
  std::vector<Index> fixed;
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The smallest height of a triangle over its longest side: 0.87 at best, negative if it is clockwise.
double flatness(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// The smallest flatness of all triangles.
double worst_flatness(const Draft& draft);

/// The smallest sine of a corner of a quad, negative if one is reflex.
double smallest_sine(const std::array<Eigen::Vector2d, 4>& corners);

/// The same of quads between points that lie in a plane of constant z.
double smallest_sine(const std::vector<Eigen::Vector3d>& points, std::span<const std::array<Index, 4>> quads);

/// One undirected edge of the triangles, with what lies on its two sides.
struct DraftEdge {
  Index a = kNone, b = kNone;                   ///< a < b
  std::array<Index, 2> triangle{kNone, kNone};  ///< [0] has a -> b, [1] has b -> a; kNone beyond the boundary
  std::array<Index, 2> apex{kNone, kNone};
  bool on_boundary() const { return triangle[0] == kNone || triangle[1] == kNone; }
};

/// All edges of the triangles, sorted by (a, b).
std::vector<DraftEdge> edges_of(const Draft& draft);

/// 1 for each node that is on an edge with one element only.
std::vector<char> boundary_nodes(const Draft& draft);

/// Keeps the triangles with keep[t] and the points that they use. For drafts without constraints.
void keep_triangles(Draft& draft, const std::vector<char>& keep);

/// Of the triangles with keep[t], leaves only the largest set that is joined through edges.
void keep_largest_part(const Draft& draft, std::vector<char>& keep);

/// Drops points that no element uses and renumbers the rest in order.
void drop_unused_points(Draft& draft);

}  // namespace qmorph::test
