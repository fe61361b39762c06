// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/creases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "kernel/sort_unique.hpp"

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

/// The normal of a triangle that is not so high, relative to its longest side, says nothing.
constexpr double kLeastHeight = 1e-3;

bool has_normal(const Background& surface, Index t) {
  double longest = 0;
  for (int i = 0; i < 3; ++i)
    longest = std::max(longest, (surface.corner(t, (i + 1) % 3) - surface.corner(t, i)).squaredNorm());
  const double area =
      (surface.corner(t, 1) - surface.corner(t, 0)).cross(surface.corner(t, 2) - surface.corner(t, 0)).norm();
  return area > kLeastHeight * longest;
}

/// Where an edge turns by less, it may be one of several that make a bend together: a circle of six sides is a circle.
/// In a bend, each edge turns by not much more than the surface does beyond it, on both sides.
constexpr double kMostOfBend = 75 * std::numbers::pi / 180;
constexpr double kLeastBeyond = 0.4;
constexpr Index kMostOfFan = 24;

/// By how much the surface turns on around `axis`, from the triangle of `side` to those at its corner across. Infinite
/// where the surface ends there, and how it would go on is unknown.
double turn_beyond(const Background& surface, Index side, const Vector3d& axis) {
  const Index from = side / 3, corner = 3 * from + (side + 2) % 3;
  const Vector3d start = surface.normal(from) - surface.normal(from).dot(axis) * axis;
  double most = 0;
  surface.for_fan(corner, kMostOfFan, [&](Index around) {
    if (surface.opposite(around) == kNone) most = std::numeric_limits<double>::infinity();
    const Vector3d& normal = surface.normal(around / 3);
    most = std::max(most, std::atan2(axis.dot(start.cross(normal)), start.dot(normal)));
  });
  return most;
}

bool is_of_bend(const Background& surface, Index side, double angle) {
  const Index other = surface.opposite(side);
  const Vector3d axis = surface.normal(side / 3).cross(surface.normal(other / 3)).normalized();
  return angle < kMostOfBend && turn_beyond(surface, other, axis) > kLeastBeyond * angle &&
         turn_beyond(surface, side, -axis) > kLeastBeyond * angle;
}

/// Faces between creases, by triangle: the number of the face.
std::vector<Index> faces_between(const Background& surface, const std::vector<bool>& is_crease, Index& count) {
  std::vector<Index> face(surface.triangles(), kNone);
  count = 0;
  for (Index first = 0; first < surface.triangles(); ++first) {
    if (face[first] != kNone) continue;
    face[first] = count;
    std::vector<Index> some{first};
    for (std::size_t k = 0; k < some.size(); ++k)
      for (Index side = 3 * some[k]; side < 3 * some[k] + 3; ++side) {
        const Index other = surface.opposite(side);
        if (other == kNone || is_crease[side] || face[other / 3] != kNone) continue;
        face[other / 3] = count;
        some.push_back(other / 3);
      }
    ++count;
  }
  return face;
}

/// A face between creases that is one triangle, or two beside some that have no normal, is a fault of the
/// triangulation, not one of the shape: what is sharp around it says nothing.
void drop_around_crumbs(const Background& surface, const std::vector<char>& counts, std::vector<bool>& is_crease) {
  constexpr std::size_t kFew = 2;
  Index faces = 0;
  const std::vector<Index> face = faces_between(surface, is_crease, faces);
  std::vector<std::size_t> all(faces, 0), with_normal(faces, 0);
  for (Index t = 0; t < surface.triangles(); ++t) ++all[face[t]], with_normal[face[t]] += counts[t] != 0;
  for (Index side = 0; side < is_crease.size(); ++side) {
    const Index f = face[side / 3];
    if (!is_crease[side] || !(with_normal[f] <= 1 || (with_normal[f] <= kFew && with_normal[f] < all[f]))) continue;
    is_crease[side] = is_crease[surface.opposite(side)] = false;
  }
}

/// Where few triangles meet at the tip of a cone, the edges between them are sharp, and the next ones outwards perhaps:
/// what the triangulation makes of the tip, and no creases. All that begin at such a node end in the surface soon.
class TipCreases {
 public:
  TipCreases(const Background& surface, std::vector<bool>& is_crease)
      : surface_(surface), is_crease_(is_crease), before_(surface.points().size(), kNone), after_(before_) {
    std::vector<std::pair<Index, Index>> ends;  // node, side that is a crease and starts there
    for (Index side = 0; side < is_crease.size(); ++side) {
      if (surface.opposite(side) == kNone) after_[node(side)] = target(side), before_[target(side)] = node(side);
      if (is_crease[side]) ends.emplace_back(node(side), side);
    }
    std::sort(ends.begin(), ends.end());
    first_.assign(surface.points().size() + 1, 0);
    for (const auto& [v, side] : ends) ++first_[v + 1], sides_.push_back(side);
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  }

  void drop() {
    for (Index v = 0; v + 1 < first_.size(); ++v) {
      const std::span<const Index> here = at(v);
      if (here.size() < fewest_at(v)) continue;
      std::vector<Index> all;
      if (!std::all_of(here.begin(), here.end(), [&](Index side) { return ends_soon(side, all); })) continue;
      for (const Index side : all) is_crease_[side] = is_crease_[surface_.opposite(side)] = false;
    }
  }

 private:
  Index node(Index side) const { return surface_.corners(side / 3)[side % 3]; }
  Index target(Index side) const { return surface_.corners(side / 3)[(side % 3 + 1) % 3]; }
  std::span<const Index> at(Index v) const { return {sides_.data() + first_[v], first_[v + 1] - first_[v]}; }

  bool is_outer(Index v) const { return before_[v] != kNone || after_[v] != kNone; }

  /// At the end of a line, as of a cone's seam, one is as good as two elsewhere on the boundary. On both sides of a
  /// line there are nodes of their own.
  std::size_t fewest_at(Index v) const {
    if (!is_outer(v)) return 3;
    const bool is_end =
        before_[v] != kNone && after_[v] != kNone && surface_.points()[before_[v]] == surface_.points()[after_[v]];
    return is_end ? 1 : 2;
  }

  /// Adds the way.
  bool ends_soon(Index side, std::vector<Index>& way) const {
    constexpr int kFewEdges = 3;
    for (int edges = 0; edges < kFewEdges; ++edges) {
      way.push_back(side);
      const Index v = target(side);
      const std::span<const Index> onwards = at(v);
      if (is_outer(v) || onwards.size() > 2) return false;
      if (onwards.size() == 1) return true;
      side = target(onwards[0]) == node(side) ? onwards[1] : onwards[0];
    }
    return false;
  }

  const Background& surface_;
  std::vector<bool>& is_crease_;
  std::vector<Index> before_, after_;  ///< by node: along the boundary; kNone inside
  std::vector<Index> first_, sides_;
};

}  // namespace

std::vector<std::pair<Index, Index>> find_creases(const Background& surface, double angle) {
  std::vector<std::pair<Index, Index>> creases;
  if (angle >= std::numbers::pi) return creases;
  const double least = std::cos(angle);
  std::vector<char> counts(surface.triangles(), 0);
  std::vector<bool> is_crease(3 * surface.triangles(), false);
  for (Index t = 0; t < surface.triangles(); ++t) counts[t] = has_normal(surface, t);
  for (Index side = 0; side < 3 * surface.triangles(); ++side) {
    const Index other = surface.opposite(side), t = side / 3;
    if (other == kNone || other < side || !counts[t] || !counts[other / 3]) continue;
    const double cosine = surface.normal(t).dot(surface.normal(other / 3));
    if (cosine >= least || is_of_bend(surface, side, std::acos(std::max(-1.0, cosine)))) continue;
    is_crease[side] = is_crease[other] = true;
  }
  TipCreases(surface, is_crease).drop();
  drop_around_crumbs(surface, counts, is_crease);
  TipCreases(surface, is_crease).drop();  // what joined one to others may have gone
  for (Index side = 0; side < is_crease.size(); ++side)
    if (is_crease[side])
      creases.push_back(std::minmax(surface.corners(side / 3)[side % 3], surface.corners(side / 3)[(side + 1) % 3]));
  sort_unique(creases);
  return creases;
}

}  // namespace qmorph::space
