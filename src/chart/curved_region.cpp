// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/curved_region.hpp"

#include "chart/creases.hpp"

namespace qmorph::chart {
namespace {

/// Points in the plane for what only needs neighbours to be near each other: the two coordinates that vary most.
std::vector<Vec2> shadow(const Patch& patch) {
  Eigen::Vector3d low = patch.points[0], high = low;
  for (const auto& p : patch.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  Eigen::Index thin = 0;
  (high - low).minCoeff(&thin);
  std::vector<Vec2> points;
  points.reserve(patch.points.size());
  for (const auto& p : patch.points) points.emplace_back(p[(thin + 1) % 3], p[(thin + 2) % 3]);
  return points;
}

}  // namespace

CurvedRegion::CurvedRegion(const Patch& patch, Region cut, double crease_angle) : region(std::move(cut)) {
  for (Index row : region.node) points.push_back(patch.points[row]);
  for (Index side = 0; side < region.open.size(); ++side)
    if (region.open[side])
      barriers.push_back({region.triangles[side / 3][side % 3], region.triangles[side / 3][(side + 1) % 3]});
  background = std::make_unique<const space::Background>(points, region.triangles, barriers);
  creases = find_creases(*background, crease_angle);
}

SurfaceMesh CurvedRegion::start() const {
  SurfaceMesh mesh;
  mesh.points = points;
  mesh.on.assign(points.size(), kNone);
  mesh.fixed.assign(points.size(), 0);
  mesh.node = region.node;
  for (Index v : region.fixed) mesh.fixed[v] = 1;
  mesh.open.assign(4 * region.triangles.size(), false);
  for (Index t = 0; t < region.triangles.size(); ++t) {
    const auto& [a, b, c] = region.triangles[t];
    for (Index v : {a, b, c}) mesh.on[v] = t;
    mesh.faces.push_back({a, b, c, kNone});
    mesh.near.push_back(t);
    for (Index i = 0; i < 3; ++i) mesh.open[4 * t + i] = region.open[3 * t + i];
  }
  return mesh;
}

std::vector<CurvedRegion> curved_regions(const Patch& patch, double crease_angle) {
  std::vector<CurvedRegion> regions;
  for (Region& region : cut_into_regions(patch, shadow(patch)))
    regions.emplace_back(patch, std::move(region), crease_angle);
  return regions;
}

}  // namespace qmorph::chart
