// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace qmorph::space {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

/// The lowest 21 bits of v with two zeros after each.
std::uint64_t spread(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffff;
  v = (v | v << 16) & 0x1f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  return (v | v << 2) & 0x1249249249249249;
}

/// Place of a point along a Z-curve through the box.
std::uint64_t z_code(const Vector3d& p, const AlignedBox3d& box) {
  std::uint64_t code = 0;
  for (int i = 0; i < 3; ++i) {
    const double extent = box.sizes().maxCoeff();
    const double share = extent > 0 ? (p[i] - box.min()[i]) / extent : 0;
    code |= spread(std::uint64_t(std::clamp(share, 0.0, 1.0) * 0x1fffff)) << i;
  }
  return code;
}

}  // namespace

TriangleTree::TriangleTree(std::span<const Vector3d> points, std::span<const Background::Triangle> triangles)
    : points_(points), triangles_(triangles) {
  std::vector<AlignedBox3d> boxes(triangles.size());
  AlignedBox3d all;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (Index v : triangles[t]) boxes[t].extend(points[v]);
    all.extend(boxes[t]);
  }
  std::vector<std::pair<std::uint64_t, Index>> places(triangles.size());
  for (Index t = 0; t < triangles.size(); ++t) places[t] = {z_code(boxes[t].center(), all), t};
  std::sort(places.begin(), places.end());
  order_.reserve(places.size());
  of_triangle_.reserve(places.size());
  for (const auto& place : places) order_.push_back(place.second), of_triangle_.push_back(boxes[place.second]);

  while (leaves_ * kLeaf < order_.size()) leaves_ *= 2;
  boxes_.assign(2 * leaves_, AlignedBox3d());
  for (std::size_t i = 0; i < order_.size(); ++i) boxes_[leaves_ + i / kLeaf].extend(of_triangle_[i]);
  for (std::size_t n = leaves_ - 1; n > 0; --n) boxes_[n] = boxes_[2 * n].merged(boxes_[2 * n + 1]);
}

Foot TriangleTree::closest(const Vector3d& p, double within, std::span<const Index> label, Index only) const {
  Foot best;
  best.distance2 = within * within;
  std::array<std::pair<double, std::size_t>, 64> stack;  // nodes with the squared distances of their boxes
  std::size_t depth = 0;
  const auto distance2 = [&](std::size_t node) {
    return boxes_[node].isEmpty() ? std::numeric_limits<double>::infinity() : boxes_[node].squaredExteriorDistance(p);
  };
  stack[depth++] = {distance2(1), 1};
  while (depth > 0) {
    const auto [nearest, node] = stack[--depth];
    if (!(nearest < best.distance2)) continue;
    if (node >= leaves_) {
      const std::size_t first = (node - leaves_) * kLeaf, last = std::min(first + kLeaf, order_.size());
      for (std::size_t i = first; i < last; ++i) {
        if (!label.empty() && label[order_[i]] != only) continue;
        if (!(of_triangle_[i].squaredExteriorDistance(p) < best.distance2)) continue;
        const auto& [a, b, c] = triangles_[order_[i]];
        const OnTriangle there = closest_on_triangle(p, points_[a], points_[b], points_[c]);
        if (there.distance2 < best.distance2) best = {there, order_[i]};
      }
      continue;
    }
    std::pair<double, std::size_t> near{distance2(2 * node), 2 * node}, far{distance2(2 * node + 1), 2 * node + 1};
    if (far.first < near.first) std::swap(near, far);
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return best;
}

}  // namespace qmorph::space
