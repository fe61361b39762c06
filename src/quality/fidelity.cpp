// SPDX-License-Identifier: GPL-2.0-or-later
#include "qmorph/fidelity.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "quality/judged.hpp"
#include "quality/percentile.hpp"

namespace qmorph {
namespace {

using Eigen::Vector3d;
using space::Background;
using space::Corners;
using space::Foot;

double angle_deg(const Vector3d& a, const Vector3d& b) {
  if (a.isZero() || b.isZero()) return 0;
  return 2 * std::atan2((a - b).norm(), (a + b).norm()) * 180 / std::numbers::pi;
}

Vector3d half_normal(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d area = (b - a).cross(c - a);
  const double length = area.norm();
  return length > 0 ? Vector3d(area / length) : Vector3d::Zero();
}

double warpage_deg(const Corners<4>& p) {
  return std::min(angle_deg(half_normal(p[0], p[1], p[2]), half_normal(p[0], p[2], p[3])),
                  angle_deg(half_normal(p[1], p[2], p[3]), half_normal(p[1], p[3], p[0])));
}

/// Mean length of the edges at each node; those of boundaries and constraints may count twice.
template <class Ends>
std::vector<double> mean_edges(std::span<const Vector3d> points, Index sides, const Ends& ends) {
  std::vector<double> sum(points.size(), 0);
  std::vector<Index> count(points.size(), 0);
  for (Index side = 0; side < sides; ++side) {
    const auto [a, b] = ends(side);
    if (a == kNone) continue;
    const double length = (points[a] - points[b]).norm();
    for (Index v : {a, b}) sum[v] += length, ++count[v];
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (count[v]) sum[v] /= count[v];
  return sum;
}

double share(double distance2, double length) { return length > 0 ? std::sqrt(distance2) / length : 0; }

/// The way from the surface to the elements on it.
class WayBack {
 public:
  explicit WayBack(const space::Result& result) : result_(result), element_(result.surface().triangles(), kNone) {
    for (Index e = 0; e < result.sides().elements(); ++e) balls_.push_back(ball_around(e));
    std::vector<Index> queue;
    for (Index e = 0; e < result.sides().elements(); ++e)
      if (const Index t = result.triangle(e); element_[t] == kNone) element_[t] = e, queue.push_back(t);
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (int i = 0; i < 3; ++i)
        if (const Index t = result.surface().neighbour(queue[k], i); t != kNone && element_[t] == kNone)
          element_[t] = element_[queue[k]], queue.push_back(t);
  }

  /// Squared distance of a point near a triangle of the surface from the elements there, by a walk downhill.
  double distance2(const Vector3d& p, Index triangle) const {
    constexpr int kMostSteps = 100;
    Index best = element_[triangle];
    if (best == kNone) return 0;
    double least = to_element(p, best);
    for (int step = 0; step < kMostSteps && least > 0; ++step) {
      const Index from = best;
      for (Index side = 4 * from; side < 4 * from + 4; ++side) {
        if (result_.sides().node(side) == kNone) continue;
        const Index before = result_.sides().opposite(result_.sides().previous(side));  // looked at from there
        result_.sides().for_fan(side, [&](Index other) {
          const Index e = other / 4;
          if (e == from || (before != kNone && e == before / 4) || is_farther(p, e, least)) return;
          const double there = to_element(p, e);
          if (there < least) least = there, best = e;
        });
      }
      if (best == from) break;
    }
    return least;
  }

 private:
  double to_element(const Vector3d& p, Index e) const {
    const space::ElementSides& sides = result_.sides();
    const auto corner = [&](Index i) -> const Vector3d& { return result_.mesh().points[sides.node(4 * e + i)]; };
    if (sides.is_triangle(e)) return space::closest_on_triangle(p, corner(0), corner(1), corner(2)).distance2;
    const Vector3d centre = 0.25 * (corner(0) + corner(1) + corner(2) + corner(3));
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < 4; ++i)
      least = std::min(least, space::closest_on_triangle(p, corner(i), corner((i + 1) % 4), centre).distance2);
    return least;
  }

  /// An element lies inside.
  struct Ball {
    Vector3d centre;
    double radius;
  };
  Ball ball_around(Index e) const {
    const space::ElementSides& sides = result_.sides();
    const Index degree = sides.is_triangle(e) ? 3 : 4;
    const auto corner = [&](Index i) -> const Vector3d& { return result_.mesh().points[sides.node(4 * e + i)]; };
    Ball ball{Vector3d::Zero(), 0};
    for (Index i = 0; i < degree; ++i) ball.centre += corner(i) / double(degree);
    for (Index i = 0; i < degree; ++i) ball.radius = std::max(ball.radius, (corner(i) - ball.centre).norm());
    ball.radius *= 1 + kRounding;
    return ball;
  }
  /// Surely; which takes little time to see.
  bool is_farther(const Vector3d& p, Index e, double distance2) const {
    const double reach = balls_[e].radius + std::sqrt(distance2);
    return (p - balls_[e].centre).squaredNorm() > reach * reach * (1 + kRounding);
  }

  static constexpr double kRounding = 1e-9;
  const space::Result& result_;
  std::vector<Index> element_;  ///< by triangle of the surface
  std::vector<Ball> balls_;     ///< by element
};

}  // namespace

void FidelityAccumulator::Values::add(double value, const Vector3d& place) {
  all.push_back(float(value));
  sum += value;
  if (value > max) max = value, where = place;
}

void FidelityAccumulator::Values::add(const Values& other) {
  all.insert(all.end(), other.all.begin(), other.all.end());
  sum += other.sum;
  if (other.max > max) max = other.max, where = other.where;
}

Spread FidelityAccumulator::Values::spread() const {
  if (all.empty()) return {};
  std::vector<double> values(all.begin(), all.end());
  return {sum / double(all.size()), percentile(values, 99), max, where};
}

void FidelityAccumulator::add(const Patch& before, const QuadMesh& after) { Judged(before, after).add_to(*this); }

void Judged::add_to(FidelityAccumulator& figures) {
  if (!plane()) figures.add_on(before(), on_surface());
}

void FidelityAccumulator::add_any(const Patch& before, const QuadMesh& after) {
  add_on(before, space::Result(before, after));
}

void FidelityAccumulator::add_on(const Patch& before, const space::Result& result) {
  const QuadMesh& after = result.mesh();
  const space::ElementSides& sides = result.sides();
  const auto& points = after.points;
  const auto ends = [&](Index side) {
    const Index a = sides.node(side);
    return std::pair(a, a == kNone ? kNone : sides.target(side));
  };
  const std::vector<double> length = mean_edges(points, sides.slots(), ends);

  std::vector<char> seen(points.size(), 0);
  for (Index side = 0; side < sides.slots(); ++side) {
    const auto [a, b] = ends(side);
    if (a == kNone) continue;
    if (!seen[a]) seen[a] = 1, node_.add(share(result.foot(side / 4, a).distance2, length[a]), points[a]);
    if (sides.opposite(side) != kNone && sides.opposite(side) < side) continue;
    const Vector3d middle = 0.5 * (points[a] + points[b]);
    const Foot foot = result.normals().closest(middle, result.triangle(side / 4));
    side_.add(share(foot.distance2, 0.5 * (length[a] + length[b])), middle);
  }
  for (Index q = 0; q < after.quads.size(); ++q) {
    Corners<4> p;
    double edge = 0;
    for (std::size_t i = 0; i < 4; ++i) p[i] = points[after.quads[q][i]], edge += 0.25 * length[after.quads[q][i]];
    const Vector3d centre = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    const Foot foot = result.normals().closest(centre, result.triangle(Index(after.triangles.size()) + q));
    centre_.add(share(foot.distance2, edge), centre);
    normal_deg_.add(angle_deg(space::element_normal(p), result.surface().normal(foot.triangle)), centre);
    warpage_deg_.add(warpage_deg(p), centre);
  }

  const Background& surface = result.surface();
  const std::vector<double> length_before = mean_edges(before.points, 3 * surface.triangles(), [&](Index side) {
    return std::pair(surface.corners(side / 3)[side % 3], surface.corners(side / 3)[(side + 1) % 3]);
  });
  const WayBack way(result);
  std::vector<char> known(before.points.size(), 0);
  for (Index t = 0; t < surface.triangles(); ++t)
    for (Index v : surface.corners(t)) {
      if (known[v]) continue;
      known[v] = 1;
      back_.add(share(way.distance2(before.points[v], t), length_before[v]), before.points[v]);
    }
}

void FidelityAccumulator::add(const FidelityAccumulator& other) {
  node_.add(other.node_), side_.add(other.side_), centre_.add(other.centre_), back_.add(other.back_);
  normal_deg_.add(other.normal_deg_), warpage_deg_.add(other.warpage_deg_);
}

Fidelity FidelityAccumulator::result() const {
  return {centre_.all.size(), node_.spread(),       side_.spread(),       centre_.spread(),
          back_.spread(),     normal_deg_.spread(), warpage_deg_.spread()};
}

}  // namespace qmorph
