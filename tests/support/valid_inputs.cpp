// SPDX-License-Identifier: GPL-2.0-or-later
#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "support/complaints.hpp"
#include "support/domains.hpp"
#include "support/invariants.hpp"
#include "support/sides.hpp"

namespace qmorph::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFlat = 1e-6;  // the sine of a corner of a valid triangle is above this

struct BoundaryEdge {
  Index a, b;
};

/// -1, 0 or 1: on which side of ab c is; 0 also where rounding may decide.
int side_of(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d way = b - a, other = c - a;
  const double area = way.x() * other.y() - way.y() * other.x();
  if (std::abs(area) <= 1e-10 * way.norm() * (way.norm() + other.norm())) return 0;
  return area > 0 ? 1 : -1;
}

/// Boundary edges that cross properly: every pair, these are small.
void check_crossings(const Patch& patch, const std::vector<BoundaryEdge>& edges, const Vector3d& normal,
                     Complaints& bad) {
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Vector2d> flat;
  for (const Vector3d& p : patch.points) flat.emplace_back(u.dot(p - patch.points[0]), v.dot(p - patch.points[0]));
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto [a, b] = edges[i];
      const auto [c, d] = edges[j];
      if (a == c || a == d || b == c || b == d) continue;
      if (side_of(flat[a], flat[b], flat[c]) * side_of(flat[a], flat[b], flat[d]) < 0 &&
          side_of(flat[c], flat[d], flat[a]) * side_of(flat[c], flat[d], flat[b]) < 0)
        bad.add("overlap", "boundary edges cross near ", at(patch.points[a]));
    }
}

void check_elements(const Patch& patch, const Vector3d& normal, Complaints& bad) {
  const auto check = [&](const auto& elements) {
    for (const auto& nodes : elements)
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vector3d& p = patch.points[nodes[i]];
        const Vector3d ahead = patch.points[nodes[(i + 1) % nodes.size()]] - p;
        const Vector3d behind = patch.points[nodes[(i + nodes.size() - 1) % nodes.size()]] - p;
        const double sine = ahead.cross(behind).dot(normal) / (ahead.norm() * behind.norm());
        if (!(sine > kFlat)) bad.add("orientation", "a corner of sine ", sine, " at ", at(p));
      }
  };
  check(patch.triangles);
  check(patch.quads);
}

}  // namespace

std::vector<std::string> broken_inputs(const Patch& patch) {
  Complaints bad;
  if (patch.triangles.empty()) bad.add("empty", "no triangle");
  for (const Vector3d& p : patch.points)
    if (!p.allFinite()) bad.add("not finite", at(p));
  std::vector<char> used(patch.points.size(), 0);
  const auto mark = [&](const auto& elements) {
    for (const auto& nodes : elements)
      for (const Index i : nodes) used.at(i) = 1;
  };
  mark(patch.triangles);
  mark(patch.quads);
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i]) bad.add("unused", at(patch.points[i]));
  if (!bad.empty()) return bad.lines();

  const Vector3d normal = area_vector(patch.points, patch.triangles, patch.quads).normalized();
  check_elements(patch, normal, bad);

  std::vector<BoundaryEdge> boundary;
  std::set<std::pair<Index, Index>> edges;
  for_each_edge(sides_of(patch.triangles, patch.quads), [&](auto first, auto last) {
    edges.insert({first->low, first->high});
    if (last - first > 2 || (last - first == 2 && first[0].forward == first[1].forward))
      bad.add("manifold", "at the edge from ", at(patch.points[first->low]));
    if (last - first == 1) boundary.push_back({first->low, first->high});
  });
  check_crossings(patch, boundary, normal, bad);
  std::set<std::pair<Index, Index>> seen;
  for (const auto& [a, b] : patch.constraints) {
    if (!edges.contains(std::minmax(a, b))) bad.add("constraint", "no edge at ", at(patch.points[a]));
    if (!seen.insert(std::minmax(a, b)).second) bad.add("constraint", "twice at ", at(patch.points[a]));
  }
  std::set<Index> fixed;
  for (const Index i : patch.fixed)
    if (i >= patch.points.size() || !fixed.insert(i).second) bad.add("fixed", "node ", i, " is not there, or twice");
  return bad.lines();
}

}  // namespace qmorph::test
