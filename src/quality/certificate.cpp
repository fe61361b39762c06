// SPDX-License-Identifier: GPL-2.0-or-later
#include "qmorph/certificate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "quality/shapes.hpp"
#include "space/corners.hpp"
#include "space/element_sides.hpp"
#include "space/faults.hpp"
#include "space/result.hpp"

namespace qmorph {
namespace {

using Eigen::Vector3d;
using space::Corners;

/// Distance of p from the segment ab.
double distance(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double share = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0;
  return (p - a - share * ab).norm();
}

class Explanation {
 public:
  Explanation(const Patch& before, const QuadMesh& after)
      : before_(before), after_(after), sides_(after.points.size(), after.triangles, after.quads, constraints()) {}

  PoorBecause reason(Index quad) {
    const Index element = Index(after_.triangles.size()) + quad;
    if (was_there(quad)) return PoorBecause::kept;
    if (fills_sharp_corner(element) || is_alone(element)) return PoorBecause::boundary_angle;
    const std::set<Index> near = neighbourhood(element);
    if (is_narrow(near)) return PoorBecause::narrow;
    if (std::any_of(near.begin(), near.end(), [&](Index e) { return sides_.is_triangle(e); }))
      return PoorBecause::odd_region;
    if (turns_sharply(quad, element)) return PoorBecause::input_geometry;
    return PoorBecause::nothing;
  }

 private:
  using Edge = std::array<Index, 2>;

  std::vector<Edge> constraints() const {
    std::vector<Index> row(before_.points.size(), kNone);
    for (Index i = 0; i < after_.source.size(); ++i)
      if (after_.source[i] != kNone) row[after_.source[i]] = i;
    std::vector<Edge> edges;
    for (const auto& [a, b] : before_.constraints)
      if (row[a] != kNone && row[b] != kNone) edges.push_back({row[a], row[b]});
    return edges;
  }

  bool was_there(Index quad) const {
    if (quad >= before_.quads.size() || after_.source.empty()) return false;
    for (std::size_t i = 0; i < 4; ++i)
      if (after_.source[after_.quads[quad][i]] != before_.quads[quad][i]) return false;
    return true;
  }

  double angle(Index side) const {
    const Vector3d& at = after_.points[sides_.node(side)];
    const Vector3d ahead = after_.points[sides_.target(side)] - at;
    const Vector3d behind = after_.points[sides_.node(sides_.previous(side))] - at;
    return std::atan2(ahead.cross(behind).norm(), ahead.dot(behind));
  }

  bool is_open(Index side) const { return sides_.opposite(side) == kNone; }

  /// One of its corners lies between two kept edges with so small an angle that no element there can be good.
  bool fills_sharp_corner(Index element) const {
    const double sharp = std::asin(kPoorQuad);
    for (Index side = 4 * element; side < 4 * element + sides_.degree(element); ++side)
      if (is_open(side) && is_open(sides_.previous(side)) && angle(side) < sharp) return true;
    return false;
  }

  /// Between four kept edges.
  bool is_alone(Index element) const {
    for (Index side = 4 * element; side < 4 * element + 4; ++side)
      if (!is_open(side)) return false;
    return true;
  }

  /// The element and those that share a node with it, on its side of what is kept.
  std::set<Index> neighbourhood(Index element) const {
    std::set<Index> near;
    for (Index side = 4 * element; side < 4 * element + sides_.degree(element); ++side)
      sides_.for_fan(side, [&](Index other) { near.insert(other / 4); });
    return near;
  }

  /// A kept node is so near to a kept edge which it does not belong to that there is no room for good quads between
  /// them.
  bool is_narrow(const std::set<Index>& elements) {
    std::vector<Edge> edges;
    std::set<Index> nodes;
    for (Index e : elements)
      for (Index side = 4 * e; side < 4 * e + sides_.degree(e); ++side) {
        if (is_fixed(sides_.node(side))) nodes.insert(sides_.node(side));
        if (!is_open(side)) continue;
        edges.push_back({sides_.node(side), sides_.target(side)});
        nodes.insert({sides_.node(side), sides_.target(side)});
      }
    for (const auto& [a, b] : edges) {
      const Vector3d &pa = after_.points[a], &pb = after_.points[b];
      const double near = kPoorQuad * (pb - pa).norm();
      for (Index v : nodes)
        if (v != a && v != b && distance(after_.points[v], pa, pb) < near && !runs_on(edges, v, a, b)) return true;
    }
    return false;
  }

  bool is_fixed(Index node) {
    if (fixed_.empty()) {
      fixed_.assign(before_.points.size(), 0);
      for (Index row : before_.fixed) fixed_[row] = 1;
    }
    const Index row = after_.source.empty() ? kNone : after_.source[node];
    return row != kNone && fixed_[row];
  }

  /// v is the next kept node after a or b, and the way there runs on rather than back: a short edge beside a long one.
  bool runs_on(const std::vector<Edge>& edges, Index v, Index a, Index b) const {
    return std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      const auto goes = [&](Index from, Index other) {
        if (!((edge[0] == from && edge[1] == v) || (edge[1] == from && edge[0] == v))) return false;
        const Vector3d onward = after_.points[v] - after_.points[from],
                       back = after_.points[other] - after_.points[from];
        return onward.dot(back) < std::sqrt(1 - kPoorQuad * kPoorQuad) * onward.norm() * back.norm();
      };
      return goes(a, b) || goes(b, a);
    });
  }

  bool turns_sharply(Index quad, Index element) {
    if (!is_curved_) is_curved_ = !plane_normal(before_).has_value();
    if (!*is_curved_) return false;
    if (!result_) result_.emplace(before_, after_);
    Corners<4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = after_.points[after_.quads[quad][i]];
    return space::is_folded_under(result_->surface(), result_->normals(), p, result_->triangle(element));
  }

  const Patch& before_;
  const QuadMesh& after_;
  const space::ElementSides sides_;
  std::vector<char> fixed_;  ///< by row of the patch's points
  std::optional<bool> is_curved_;
  std::optional<space::Result> result_;  ///< only where it is needed
};

}  // namespace

std::string_view name_of(PoorBecause reason) {
  switch (reason) {
    case PoorBecause::kept:
      return "quads of the input";
    case PoorBecause::boundary_angle:
      return "the angles of its boundary";
    case PoorBecause::narrow:
      return "curves or nodes too close";
    case PoorBecause::odd_region:
      return "the triangle of an odd region";
    case PoorBecause::input_geometry:
      return "the surface folded within it";
    case PoorBecause::nothing:
      return "nothing";
  }
  return "";
}

std::vector<PoorQuad> explain_poor_quads(const Patch& before, const QuadMesh& after,
                                         std::span<const double> scaled_jacobians) {
  std::vector<PoorQuad> poor;
  std::optional<Explanation> explanation;
  for (Index q = 0; q < after.quads.size(); ++q) {
    if (!(scaled_jacobians[q] < kPoorQuad)) continue;
    if (!explanation) explanation.emplace(before, after);
    Vector3d centre = Vector3d::Zero();
    for (Index v : after.quads[q]) centre += 0.25 * after.points[v];
    poor.push_back({q, scaled_jacobians[q], explanation->reason(q), centre});
  }
  return poor;
}

}  // namespace qmorph
