// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/reference.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

/// Cosine of the angle between the normals of abc and acd, times their areas; negative where the cut leaves the quad.
double flatness(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d abc = (b - a).cross(c - a), acd = (c - a).cross(d - a);
  const double lengths = abc.norm() * acd.norm();
  return lengths > 0 ? abc.dot(acd) / lengths : -1;
}

void add_halves(std::vector<Background::Triangle>& triangles, Index a, Index b, Index c, Index d) {
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

}  // namespace

std::vector<Background::Triangle> Reference::with_halves(const Patch& patch) {
  if (patch.quads.empty()) return {};
  std::vector<Background::Triangle> triangles = patch.triangles;
  triangles.reserve(patch.triangles.size() + 2 * patch.quads.size());
  for (const auto& [a, b, c, d] : patch.quads) {
    const Vector3d &pa = patch.points[a], &pb = patch.points[b], &pc = patch.points[c], &pd = patch.points[d];
    if (flatness(pa, pb, pc, pd) >= flatness(pb, pc, pd, pa))
      add_halves(triangles, a, b, c, d);
    else
      add_halves(triangles, b, c, d, a);
  }
  return triangles;
}

std::vector<Background::Triangle> Reference::other_halves(const Patch& patch) {
  constexpr double kAlike = 1e-9;
  std::vector<Background::Triangle> triangles;
  for (const auto& [a, b, c, d] : patch.quads) {
    const Vector3d &pa = patch.points[a], &pb = patch.points[b], &pc = patch.points[c], &pd = patch.points[d];
    const double first = flatness(pa, pb, pc, pd), second = flatness(pb, pc, pd, pa);
    if (std::abs(first - second) > kAlike) continue;
    if (first >= second)
      add_halves(triangles, b, c, d, a);
    else
      add_halves(triangles, a, b, c, d);
  }
  return triangles;
}

}  // namespace qmorph::space
