// SPDX-License-Identifier: GPL-2.0-or-later
#include "qmorph/certificate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "quality/judged.hpp"
#include "space/closest_point.hpp"
#include "space/corners.hpp"
#include "space/creases.hpp"
#include "space/element_sides.hpp"
#include "space/faults.hpp"

namespace qmorph {
namespace {

using Eigen::Vector3d;
using space::Corners;

/// Distance of p from the segment ab.
double distance(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  return (p - a - space::closest_on_segment(p, a, b) * (b - a)).norm();
}

class Explanation {
 public:
  Explanation(Judged& judged, double crease_angle)
      : judged_(judged),
        before_(judged.before()),
        after_(judged.after()),
        is_curved_(!judged.plane()),
        sides_(after_.points.size(), after_.triangles, after_.quads, kept_edges(crease_angle)) {}

  PoorBecause reason(Index quad) {
    const Index element = Index(after_.triangles.size()) + quad;
    if (was_there(quad)) return PoorBecause::kept;
    if (fills_sharp_corner(element) || is_alone(element)) return PoorBecause::boundary_angle;
    const std::set<Index> near = neighbours({element});
    if (is_narrow(near) || is_beside_long_edge(quad, near)) return PoorBecause::narrow;
    if (std::any_of(near.begin(), near.end(), [&](Index e) { return sides_.is_triangle(e); }))
      return PoorBecause::odd_region;
    if (turns_sharply(quad, element)) return PoorBecause::input_geometry;
    return PoorBecause::nothing;
  }

 private:
  using Edge = std::array<Index, 2>;

  /// Constraints, and creases that are not told from them in the result.
  std::vector<Edge> kept_edges(double crease_angle) const {
    std::vector<Index> row(before_.points.size(), kNone);
    for (Index i = 0; i < after_.source.size(); ++i)
      if (after_.source[i] != kNone) row[after_.source[i]] = i;
    std::vector<Edge> edges;
    const auto add = [&](Index a, Index b) {
      if (row[a] != kNone && row[b] != kNone) edges.push_back({row[a], row[b]});
    };
    for (const auto& [a, b] : before_.constraints) add(a, b);
    if (is_curved_ && !before_.triangles.empty()) {
      std::vector<space::Background::Edge> barriers;
      for (const auto& [a, b] : before_.constraints) barriers.push_back({a, b});
      const space::Background surface(before_.points, before_.triangles, barriers);
      for (const auto& [a, b] : space::find_creases(surface, space::crease_angle_of(before_, crease_angle))) add(a, b);
    }
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

  /// One of its corners lies between two kept edges with so small an angle that no element there can be good, be it
  /// alone between them or not.
  bool fills_sharp_corner(Index element) const {
    const double sharp = std::asin(kPoorQuad);
    for (Index side = 4 * element; side < 4 * element + sides_.degree(element); ++side) {
      double sum = 0;
      sides_.for_fan(side, [&](Index other) { sum += angle(other); });
      if (sum < sharp) return true;
    }
    return false;
  }

  /// Between four kept edges.
  bool is_alone(Index element) const {
    for (Index side = 4 * element; side < 4 * element + 4; ++side)
      if (!is_open(side)) return false;
    return true;
  }

  /// These elements and those that share a node with them, on their side of what is kept.
  std::set<Index> neighbours(const std::set<Index>& elements) const {
    std::set<Index> near;
    for (Index element : elements)
      for (Index side = 4 * element; side < 4 * element + sides_.degree(element); ++side)
        sides_.for_fan(side, [&](Index other) { near.insert(other / 4); });
    return near;
  }

  struct Kept {
    std::vector<Edge> edges;
    std::set<Index> nodes;
  };

  Kept kept_of(const std::set<Index>& elements) {
    Kept kept;
    for (Index e : elements)
      for (Index side = 4 * e; side < 4 * e + sides_.degree(e); ++side) {
        if (is_fixed(sides_.node(side))) kept.nodes.insert(sides_.node(side));
        if (!is_open(side)) continue;
        kept.edges.push_back({sides_.node(side), sides_.target(side)});
        kept.nodes.insert({sides_.node(side), sides_.target(side)});
      }
    return kept;
  }

  /// A kept node is so near to a kept edge which it does not belong to that there is no room for good quads between
  /// them. Where it faces an end of the edge there is: however thin a ladder is, its rungs may stand upright.
  bool is_narrow(const std::set<Index>& elements) {
    const Kept kept = kept_of(elements);
    return std::any_of(kept.edges.begin(), kept.edges.end(),
                       [&](const Edge& edge) { return is_near_any(edge, kept.nodes, kept.edges); });
  }

  /// The same for a kept edge that is longer than several elements, and lies beyond the next ones: so does the quad
  /// between it and the node.
  bool is_beside_long_edge(Index quad, const std::set<Index>& near) {
    const Kept around = kept_of(near), beyond = kept_of(neighbours(near));
    Vector3d centre = Vector3d::Zero();
    for (Index v : after_.quads[quad]) centre += 0.25 * after_.points[v];
    return std::any_of(beyond.edges.begin(), beyond.edges.end(), [&](const Edge& edge) {
      return distance(centre, after_.points[edge[0]], after_.points[edge[1]]) < reach(edge) &&
             is_near_any(edge, around.nodes, beyond.edges);
    });
  }

  double reach(const Edge& edge) const { return kPoorQuad * (after_.points[edge[1]] - after_.points[edge[0]]).norm(); }

  bool is_near_any(const Edge& edge, const std::set<Index>& nodes, const std::vector<Edge>& edges) const {
    const Index a = edge[0], b = edge[1];  // no structured binding, which Clang 14 does not capture
    const Vector3d &pa = after_.points[a], &pb = after_.points[b];
    return std::any_of(nodes.begin(), nodes.end(), [&](Index v) {
      if (v == a || v == b) return false;
      const Vector3d& p = after_.points[v];
      const double rung = std::min((p - pa).norm(), (p - pb).norm());
      return distance(p, pa, pb) < std::min(reach(edge), kPoorQuad * rung) && !runs_on(edges, v, a, b);
    });
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
    if (!is_curved_) return false;
    const space::Result& result = judged_.on_surface();
    Corners<4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = after_.points[after_.quads[quad][i]];
    return space::is_folded_under(result.surface(), result.normals(), p, result.triangle(element));
  }

  Judged& judged_;
  const Patch& before_;
  const QuadMesh& after_;
  const bool is_curved_;
  const space::ElementSides sides_;
  std::vector<char> fixed_;  ///< by row of the patch's points
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
                                         std::span<const double> scaled_jacobians, double crease_angle) {
  Judged judged(before, after);
  return explain_poor_quads(judged, scaled_jacobians, crease_angle);
}

std::vector<PoorQuad> explain_poor_quads(Judged& judged, std::span<const double> scaled_jacobians,
                                         double crease_angle) {
  const QuadMesh& after = judged.after();
  std::vector<PoorQuad> poor;
  std::optional<Explanation> explanation;
  for (Index q = 0; q < after.quads.size(); ++q) {
    if (!(scaled_jacobians[q] < kPoorQuad)) continue;
    if (!explanation) explanation.emplace(judged, crease_angle);
    Vector3d centre = Vector3d::Zero();
    for (Index v : after.quads[q]) centre += 0.25 * after.points[v];
    poor.push_back({q, scaled_jacobians[q], explanation->reason(q), centre});
  }
  return poor;
}

}  // namespace qmorph
