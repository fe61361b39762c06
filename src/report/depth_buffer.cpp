// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/depth_buffer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "kernel/sort_unique.hpp"
#include "report/scene.hpp"

namespace qmorph::report {
namespace {

/// Pixels to a typical side, and along the longer side of the page.
constexpr double kPixelsToSide = 8, kLeastPixels = 800, kMostPixels = 4000;
/// Cosine of the angle to the eye below which nothing is seen of a face.
constexpr double kFromItsSide = 1e-4;
/// Depths in pixels that count as one.
constexpr double kSameDepth = 1.5;
constexpr double kNothing = -std::numeric_limits<double>::infinity();

double typical_side(std::span<const Eigen::Vector3d> points, std::span<const std::array<Index, 4>> faces) {
  std::vector<double> sides;
  for (const auto& face : faces)
    for (Index i = 0, n = corners_of(face); i < n; ++i)
      sides.push_back((points[face[(i + 1) % n]] - points[face[i]]).norm());
  if (sides.empty()) return 1;
  std::nth_element(sides.begin(), sides.begin() + std::ptrdiff_t(sides.size() / 2), sides.end());
  return sides[sides.size() / 2];
}

}  // namespace

/// A face on the grid, and the plane that its depths are taken from.
struct DepthBuffer::Flat {
  std::array<Eigen::Vector2d, 4> corners;
  Index count = 3;
  Eigen::Vector3d middle;
  double per_x = 0, per_y = 0, least = 0, most = 0;
  bool from_its_side = true;
  float depth(double x, double y) const {
    return float(std::clamp(middle.z() + per_x * (x - middle.x()) + per_y * (y - middle.y()), least, most));
  }
};

DepthBuffer::DepthBuffer(std::span<const Eigen::Vector3d> points, std::span<const std::array<Index, 4>> faces)
    : points_(points), faces_(faces) {
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  for (const auto& face : faces)
    for (Index i = 0; i < corners_of(face); ++i) size = size.cwiseMax(points[face[i]].head<2>());
  const double longer = std::max(size.maxCoeff(), std::numeric_limits<double>::min());
  pixel_ = std::clamp(typical_side(points, faces) / kPixelsToSide, longer / kMostPixels, longer / kLeastPixels);
  width_ = Index(size.x() / pixel_) + 1;
  height_ = Index(size.y() / pixel_) + 1;
  front_.assign(std::size_t(width_) * height_, kNone);
  depth_.assign(front_.size(), float(kNothing));
  for (std::size_t f = 0; f < faces.size(); ++f)
    for_pixels(flat(f), [&](std::size_t at, float depth) {
      if (depth > depth_[at]) depth_[at] = depth, front_[at] = Index(f);
    });
}

DepthBuffer::Flat DepthBuffer::flat(std::size_t f) const {
  Flat face;
  face.count = corners_of(faces_[f]);
  std::array<Eigen::Vector3d, 4> p;
  face.middle.setZero();
  face.least = -kNothing, face.most = kNothing;
  for (Index i = 0; i < face.count; ++i) {
    p[i] = points_[faces_[f][i]] / pixel_;
    face.corners[i] = p[i].head<2>();
    face.middle += p[i] / double(face.count);
    face.least = std::min(face.least, p[i].z()), face.most = std::max(face.most, p[i].z());
  }
  const Eigen::Vector3d normal = (p[2] - p[0]).cross(face.count == 4 ? p[3] - p[1] : p[1] - p[0]);
  face.from_its_side = std::abs(normal.z()) <= kFromItsSide * normal.norm();
  if (!face.from_its_side) face.per_x = -normal.x() / normal.z(), face.per_y = -normal.y() / normal.z();
  return face;
}

/// Calls visit(pixel, depth) for each pixel whose middle the face has; a reflex corner is taken for a straight one.
template <class Visit>
void DepthBuffer::for_pixels(const Flat& face, const Visit& visit) const {
  double low = -kNothing, high = kNothing;
  for (Index i = 0; i < face.count; ++i)
    low = std::min(low, face.corners[i].y()), high = std::max(high, face.corners[i].y());
  const auto first_at = [](double x) { return std::ptrdiff_t(std::ceil(x - 0.5)); };
  for (std::ptrdiff_t row = std::max<std::ptrdiff_t>(0, first_at(low)), end = first_at(high);
       row < end && row < std::ptrdiff_t(height_); ++row) {
    const double y = double(row) + 0.5;
    double from = -kNothing, to = kNothing;
    for (Index i = 0, j = face.count - 1; i < face.count; j = i++) {
      const Eigen::Vector2d &a = face.corners[i], &b = face.corners[j];
      if ((a.y() <= y) == (b.y() <= y)) continue;
      const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      from = std::min(from, x), to = std::max(to, x);
    }
    if (from > to) continue;
    for (std::ptrdiff_t x = std::max<std::ptrdiff_t>(0, first_at(from)), last = first_at(to);
         x < last && x < std::ptrdiff_t(width_); ++x)
      visit(std::size_t(row) * width_ + std::size_t(x), face.depth(double(x) + 0.5, y));
  }
}

double DepthBuffer::depth_of(std::size_t f) const {
  double depth = 0;
  const Index corners = corners_of(faces_[f]);
  for (Index i = 0; i < corners; ++i) depth += points_[faces_[f][i]].z() / corners;
  return depth;
}

/// Faces between the pixels' middles, thin ones, are seen where nothing is before their middle.
std::vector<bool> DepthBuffer::find_seen() const {
  std::vector<bool> seen(faces_.size(), false);
  for (Index f : front_)
    if (f != kNone) seen[f] = true;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (seen[f]) continue;
    const Flat face = flat(f);
    if (face.from_its_side) continue;
    bool has_pixels = false;
    for_pixels(face, [&](std::size_t, float) { has_pixels = true; });
    if (!has_pixels) seen[f] = sees(pixel_ * face.middle);
  }
  return seen;
}

/// Pairs: a face that is seen, and another that is before it at some pixel.
std::vector<DepthBuffer::Pair> DepthBuffer::find_behind(const std::vector<bool>& seen) const {
  std::vector<Pair> pairs;
  for (Index f = 0; f < faces_.size(); ++f) {
    if (!seen[f]) continue;
    Index last = f;
    for_pixels(flat(f), [&](std::size_t at, float) {
      if (front_[at] == f || front_[at] == last) return;
      last = front_[at];
      pairs.push_back({f, last});
    });
  }
  sort_unique(pairs);
  return pairs;
}

std::vector<std::size_t> DepthBuffer::back_to_front() const {
  const std::vector<bool> seen = find_seen();
  const std::vector<Pair> behind = find_behind(seen);
  std::vector<Index> waits_for(faces_.size(), 0), first(faces_.size() + 1, 0);
  for (const auto& [back, front] : behind) ++waits_for[front], ++first[back + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  using Ready = std::pair<double, Index>;  // depth, face
  std::vector<Ready> by_depth;
  for (Index f = 0; f < faces_.size(); ++f)
    if (seen[f]) by_depth.emplace_back(depth_of(f), f);
  std::sort(by_depth.begin(), by_depth.end());
  std::priority_queue<Ready, std::vector<Ready>, std::greater<>> ready;
  for (const Ready& r : by_depth)
    if (waits_for[r.second] == 0) ready.push(r);
  std::vector<std::size_t> order;
  std::vector<bool> done(faces_.size(), false);
  auto rest = by_depth.begin();
  while (order.size() < by_depth.size()) {
    if (ready.empty()) {  // a ring
      while (done[rest->second]) ++rest;
      ready.push(*rest);
    }
    const Index f = ready.top().second;
    ready.pop();
    if (done[f]) continue;
    done[f] = true;
    order.push_back(f);
    for (Index i = first[f]; i < first[f + 1]; ++i) {
      const Index front = behind[i][1];
      if (--waits_for[front] == 0 && !done[front]) ready.emplace(depth_of(front), front);
    }
  }
  return order;
}

bool DepthBuffer::sees(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d p = point / pixel_;
  const std::ptrdiff_t x = std::ptrdiff_t(std::floor(p.x())), y = std::ptrdiff_t(std::floor(p.y()));
  for (std::ptrdiff_t row = y - 1; row <= y + 1; ++row)
    for (std::ptrdiff_t column = x - 1; column <= x + 1; ++column) {
      if (row < 0 || column < 0 || row >= std::ptrdiff_t(height_) || column >= std::ptrdiff_t(width_)) return true;
      if (double(depth_[std::size_t(row) * width_ + std::size_t(column)]) <= p.z() + kSameDepth) return true;
    }
  return false;
}

}  // namespace qmorph::report
