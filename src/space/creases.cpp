// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/creases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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
  drop_around_crumbs(surface, counts, is_crease);
  for (Index side = 0; side < is_crease.size(); ++side)
    if (is_crease[side])
      creases.push_back(std::minmax(surface.corners(side / 3)[side % 3], surface.corners(side / 3)[(side + 1) % 3]));
  sort_unique(creases);
  return creases;
}

}  // namespace qmorph::space
