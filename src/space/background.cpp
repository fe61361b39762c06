// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/background.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "space/link_sides.hpp"
#include "space/unit.hpp"

namespace qmorph::space {

using Eigen::Vector3d;

Background::Background(std::span<const Vector3d> points, std::span<const Triangle> triangles,
                       std::span<const Edge> barriers)
    : points_(points), triangles_(triangles) {
  const auto ends = [&](Index side) {
    return std::pair(triangles[side / 3][side % 3], triangles[side / 3][(side + 1) % 3]);
  };
  opposite_ = link_sides(points.size(), 3 * Background::triangles(), ends, barriers);
  add_fans();
  find_clear_cosines();
}

void Background::add_fans() {
  std::vector<Vector3d> areas(triangles_.size());
  normals_.resize(triangles_.size());
  for (Index t = 0; t < triangles(); ++t) {
    areas[t] = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
    normals_[t] = unit(areas[t]);
  }
  fans_.assign(opposite_.size(), kNone);
  fan_normals_.reserve(points_.size());
  for (Index side = 0; side < fans_.size(); ++side) {
    if (fans_[side] != kNone) continue;
    Vector3d sum = Vector3d::Zero();
    for_fan(side, kNone, [&](Index e) {
      sum += areas[e / 3];
      fans_[e] = fans();
    });
    fan_normals_.push_back(unit(sum));
  }
}

void Background::find_clear_cosines() {
  constexpr double kSmooth = 0.94;                           // cosine of 20 degrees
  constexpr double kTogether = 80 * std::numbers::pi / 180;  // triangle to node and node to corner
  constexpr double kRough = 45 * std::numbers::pi / 180;
  std::vector<double> least(fan_normals_.size(), 1);
  for (Index side = 0; side < fans_.size(); ++side) {
    const double cosine = normals_[side / 3].dot(fan_normals_[fans_[side]]);
    if (!(cosine >= least[fans_[side]])) least[fans_[side]] = std::isnan(cosine) ? -1 : cosine;
  }
  clear_cosine_.resize(triangles_.size());
  for (Index t = 0; t < triangles(); ++t) {
    const double cosine = std::min({least[fan(t, 0)], least[fan(t, 1)], least[fan(t, 2)]});
    const double angle = cosine > kSmooth ? 0 : std::acos(std::max(cosine, -1.0));
    clear_cosine_[t] = angle == 0 ? kClearOfSmooth : angle < kRough ? std::cos(kTogether - angle) : 2;
  }
}

Vector3d Background::normal_near(Index t) const {
  Vector3d sum = 3 * normals_[t];
  for (int i = 0; i < 3; ++i)
    if (const Index other = neighbour(t, i); other != kNone) sum += normals_[other];
  return unit(sum);
}

Vector3d Background::smooth_normal(Index t, const Vector3d& weights) const {
  const Vector3d sum =
      weights[0] * corner_normal(t, 0) + weights[1] * corner_normal(t, 1) + weights[2] * corner_normal(t, 2);
  const double length = sum.norm();
  return length > 0 ? Vector3d(sum / length) : normals_[t];
}

Foot Background::foot_on(Index t, const Vector3d& p) const {
  return {closest_on_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2)), t};
}

Foot Background::walk(const Vector3d& p, Index hint) const {
  constexpr int kMostSteps = 1000;
  constexpr Index kMostOfFan = 24;  // in a fan of thousands, steps must stay cheap
  Foot best = foot_on(hint, p);
  for (int step = 0; step < kMostSteps; ++step) {
    const Index t = best.triangle;
    const Foot here = best;
    const auto look_at = [&](Index other) {
      if (other == t) return;
      const Foot foot = foot_on(other, p);
      if (foot.distance2 < best.distance2) best = foot;
    };
    // What is nearer to p than its foot is nearer to the foot than twice that distance: across sides that are, and at
    // corners.
    const double reach2 = 4 * here.distance2;
    const std::array<double, 3> height2 = squared_heights(here);
    for (int i = 0; i < 3; ++i)
      if (height2[i] <= reach2)
        if (const Index other = neighbour(t, i); other != kNone) look_at(other);
    if (best.triangle != t) continue;
    for (Index i = 0; i < 3; ++i)
      if ((corner(t, int(i)) - here.point).squaredNorm() <= reach2)
        for_fan(3 * t + i, kMostOfFan, [&](Index side) { look_at(side / 3); });
    if (best.triangle == t) break;
  }
  return best;
}

/// Squared distances of a foot from the sides of its triangle; 0 in a triangle without area.
std::array<double, 3> Background::squared_heights(const Foot& foot) const {
  const Vector3d &a = corner(foot.triangle, 0), &b = corner(foot.triangle, 1), &c = corner(foot.triangle, 2);
  const Vector3d ab = b - a, bc = c - b, ca = a - c;
  const double area2 = ab.cross(ca).squaredNorm();
  const auto height2 = [&](double share, const Vector3d& side) {
    const double side2 = side.squaredNorm();
    return side2 > 0 ? share * share * area2 / side2 : 0;
  };
  return {height2(foot.weights[2], ab), height2(foot.weights[0], bc), height2(foot.weights[1], ca)};
}

}  // namespace qmorph::space
