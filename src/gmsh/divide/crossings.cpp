// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/divide/crossings.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <map>

#include "geometry/predicates.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

/// Of a segment: ends that two curves have in common are rounded.
constexpr double kSame = 1e-6;

using Segment = std::array<Vec2, 2>;

/// Also where they only touch, but not in a common end.
bool cross(const Segment& s, const Segment& t) {
  const double near = kSame * std::max((s[1] - s[0]).norm(), (t[1] - t[0]).norm());
  for (const auto& p : s)
    if ((p - t[0]).norm() <= near || (p - t[1]).norm() <= near) return false;
  for (int i = 0; i < 2; ++i)
    if (std::max(s[0][i], s[1][i]) < std::min(t[0][i], t[1][i]) ||
        std::max(t[0][i], t[1][i]) < std::min(s[0][i], s[1][i]))
      return false;
  const auto are_apart = [](const Segment& of, const Segment& other) {
    return orientation(of[0], of[1], other[0]) * orientation(of[0], of[1], other[1]) > 0;
  };
  return !are_apart(s, t) && !are_apart(t, s);
}

/// Whether nodes inside of two curves are at the same place.
bool meet_inside(const Segment& s, bool s_inside, const Segment& t, bool t_inside) {
  return s_inside && t_inside && (s[0] - t[0]).norm() <= kSame * (s[1] - s[0]).norm();
}

}  // namespace

bool folds_back(const DividedCurve& curve, int segments) {
  std::vector<Vector3d> points = points_at(curve, parameters_for(curve, segments));
  points.insert(points.begin(), curve.points.front());
  points.push_back(curve.points.back());
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    if ((points[i] - points[i - 1]).dot(points[i + 1] - points[i]) < 0) return true;
  return false;
}

bool crosses_itself(const CurveModel& model, const BoundedSurface& surface, const std::vector<int>& segments) {
  constexpr std::size_t kMost = 3000;  // segments: each is compared with each
  constexpr double kFlat = 1e-9;
  std::vector<std::array<Vector3d, 2>> sides;
  std::vector<bool> starts_inside;  // by side: whether it starts at a node inside of its curve
  std::vector<Index> curve_of;
  // Curves end in a point within the geometry's tolerance only, which may be more than kSame of a segment.
  std::map<int, Vector3d> place_of;
  const auto at = [&](int point, const Vector3d& p) { return place_of.try_emplace(point, p).first->second; };
  for (Index c : surface.boundary) {
    const DividedCurve& curve = model.curves[c];
    if (curve.points.empty()) continue;
    const Vector3d first = at(curve.ends[0], curve.points.front());
    Vector3d before = first;
    std::vector<Vector3d> points = points_at(curve, parameters_for(curve, segments[c]));
    points.push_back(at(curve.ends[1], curve.points.back()));
    for (const Vector3d& p : points) {
      starts_inside.push_back(before != first);
      curve_of.push_back(c);
      sides.push_back({before, p});
      before = p;
    }
  }
  if (sides.empty() || sides.size() > kMost) return false;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& side : sides) spread += (side[0] - sides[0][0]) * (side[0] - sides[0][0]).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  if (!(axes.eigenvalues()[0] <= kFlat * axes.eigenvalues()[2])) return false;
  std::vector<Segment> flat;
  for (const auto& side : sides)
    flat.push_back({axes.eigenvectors().rightCols<2>().transpose() * side[0],
                    axes.eigenvectors().rightCols<2>().transpose() * side[1]});
  for (std::size_t i = 0; i < flat.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (cross(flat[i], flat[j]) ||
          (curve_of[i] != curve_of[j] && meet_inside(flat[i], starts_inside[i], flat[j], starts_inside[j])))
        return true;
  return false;
}

}  // namespace qmorph::adapter
