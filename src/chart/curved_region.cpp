// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/curved_region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "space/angle_sum.hpp"
#include "space/creases.hpp"

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
  barriers = boundary_edges(region);
  background = std::make_unique<const space::Background>(points, region.triangles, barriers);
  creases = space::find_creases(*background, crease_angle);
  drop_creases_of_facets();
  find_stretch();
  if (crease_angle < std::numbers::pi) find_tips(2 * std::numbers::pi * (1 - std::cos(crease_angle)));
}

/// Triangles that are long around a surface stand off it: the rows of a cylinder are pleats then, and some of their
/// edges are sharp by chance. Creases of a shape run on, but for few nodes.
void CurvedRegion::drop_creases_of_facets() {
  constexpr double kMost = 0.4;  // of the nodes inside that are on creases
  if (creases.empty()) return;
  std::vector<Index> count(points.size(), 0);
  for (const auto& [a, b] : creases) ++count[a], ++count[b];
  std::vector<char> is_outer(points.size(), 0);
  for (const auto& [a, b] : barriers) is_outer[a] = is_outer[b] = 1;
  std::size_t inner = 0, on_creases = 0, ends = 0;
  for (Index v = 0; v < points.size(); ++v) {
    if (is_outer[v]) continue;
    ++inner;
    on_creases += count[v] > 0;
    ends += count[v] > 0 && count[v] != 2;
  }
  if (!(double(ends) > kMost * double(on_creases))) return;
  if (!stretch::has_inside(region.triangles.size(), points.size(), points.size() - inner)) return;
  if (stretch::may_be_stretched(*background) && stretch::MetricField(*background).is_stretched()) creases.clear();
}

void CurvedRegion::find_stretch() {
  std::vector<char> is_outer(points.size(), 0);
  for (const auto& [a, b] : barriers) is_outer[a] = is_outer[b] = 1;
  for (const auto& [a, b] : creases) is_outer[a] = is_outer[b] = 1;
  const auto outer = std::size_t(std::count(is_outer.begin(), is_outer.end(), 1));
  if (!stretch::has_inside(region.triangles.size(), points.size(), outer)) return;
  if (!stretch::may_be_stretched(*background)) return;
  auto field = std::make_unique<const stretch::MetricField>(*background);
  if (field->is_stretched()) stretch_ = std::move(field);
}

/// A cone whose side is inclined by the angle of a crease lacks so many radians around its tip.
void CurvedRegion::find_tips(double least) {
  std::vector<space::AngleSum> sums(points.size());
  for (const auto& t : region.triangles)
    for (int i = 0; i < 3; ++i)
      sums[t[i]].add(points[t[(i + 1) % 3]] - points[t[i]], points[t[(i + 2) % 3]] - points[t[i]]);
  std::vector<char> is_outer(points.size(), 0);
  for (const auto& edge : barriers)
    for (Index v : edge) is_outer[v] = 1;
  for (Index v = 0; v < points.size(); ++v)
    if (!is_outer[v] && 2 * std::numbers::pi - sums[v].radians() > least) tips.push_back(v);
}

SurfaceMesh CurvedRegion::start() const {
  // The halves of a quad are rows that follow one another. They are in two regions where a constraint runs along the
  // diagonal, and then they stay halves.
  std::vector<std::pair<Index, Index>> halves;  // row, triangle
  for (Index t = 0; t < region.row.size(); ++t)
    if (region.row[t] >= first_half) halves.emplace_back(region.row[t], t);
  std::sort(halves.begin(), halves.end());
  std::vector<Index> other(region.triangles.size(), kNone);  // half, and the first of the two has the quad
  for (std::size_t k = 0; k + 1 < halves.size(); ++k) {
    const auto [row, t] = halves[k];
    const auto [next_row, next] = halves[k + 1];
    if ((row - first_half) % 2 != 0 || next_row != row + 1 || region.open[3 * t + 2] || region.open[3 * next]) continue;
    other[t] = next, other[next] = t;
  }
  return joined(other);
}

SurfaceMesh CurvedRegion::triangles() const { return joined(std::vector<Index>(region.triangles.size(), kNone)); }

SurfaceMesh CurvedRegion::joined(const std::vector<Index>& other) const {
  SurfaceMesh mesh;
  mesh.points = points;
  mesh.on.assign(points.size(), kNone);
  mesh.fixed.assign(points.size(), 0);
  mesh.node = region.node;
  for (Index v : region.fixed) mesh.fixed[v] = 1;
  for (Index v : tips) mesh.fixed[v] = 1;
  for (Index t = 0; t < region.triangles.size(); ++t)
    for (Index v : region.triangles[t]) mesh.on[v] = t;
  for (Index t = 0; t < region.triangles.size(); ++t) {
    const auto& [a, b, c] = region.triangles[t];
    const bool is_second = other[t] != kNone && region.row[other[t]] < region.row[t];
    if (is_second) continue;
    mesh.near.push_back(t);
    const bool is_quad = other[t] != kNone;
    mesh.faces.push_back({a, b, c, is_quad ? region.triangles[other[t]][2] : kNone});
    for (Index i = 0; i < 4; ++i) {
      const Index side = !is_quad ? 3 * t + i : i < 2 ? 3 * t + i : 3 * other[t] + i - 1;
      mesh.open.push_back((is_quad || i < 3) && region.open[side]);
    }
  }
  return mesh;
}

std::vector<CurvedRegion> curved_regions(const Patch& patch, double crease_angle, std::size_t first_half) {
  std::vector<CurvedRegion> regions;
  const auto beside = patch.quads.empty() ? nullptr : std::make_shared<const WholePatch>(patch);
  for (Region& region : cut_into_regions(patch, shadow(patch), EdgesOfMany::part)) {
    regions.emplace_back(patch, std::move(region), crease_angle);
    regions.back().first_half = first_half;
    regions.back().beside = beside;
  }
  return regions;
}

}  // namespace qmorph::chart
