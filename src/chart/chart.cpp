// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/chart.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <set>
#include <utility>

#include "chart/coarse.hpp"
namespace qmorph::chart {
namespace {

Eigen::Vector3d in_space(const Vec2& p) { return {p.x(), p.y(), 0}; }

Flattening laid_flat(const Piece& piece, const space::Background& surface, int rounds) {
  if (auto by_few = flatten_by_few(piece, surface)) return std::move(*by_few);
  return flatten(surface, piece.points.size(), rounds);
}

std::vector<Index> halves_at(std::size_t points, const std::vector<Chart::Triangle>& triangles) {
  std::vector<Index> half_at(points, kNone);
  for (Index t = 0; t < triangles.size(); ++t)
    for (Index v : triangles[t]) half_at[v] = t;
  return half_at;
}

}  // namespace

Chart::Chart(const Piece& piece, int rounds)
    : points_(piece.points),
      triangles_(piece.halves),
      barriers_(piece.barriers()),
      surface_(piece.points, piece.halves, barriers_),
      flattening_(laid_flat(piece, surface_, rounds)),
      half_at_(halves_at(piece.points.size(), piece.halves)) {}

Chart::Chart(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles,
             std::vector<space::Background::Edge> barriers, Flattening flattening)
    : points_(points),
      triangles_(triangles),
      barriers_(std::move(barriers)),
      surface_(points, triangles, barriers_),
      flattening_(std::move(flattening)),
      half_at_(halves_at(points.size(), triangles)) {}

Eigen::Vector3d Chart::weights(Index half, const Vec2& p) const {
  const auto& t = triangles_[half];
  const Vec2 &a = flat()[t[0]], &b = flat()[t[1]], &c = flat()[t[2]];
  const Eigen::Vector3d areas(cross(b - p, c - p), cross(c - p, a - p), cross(a - p, b - p));
  return areas / areas.sum();
}

Chart::Place Chart::locate(const Vec2& p, Index hint) const {
  constexpr int kMostSteps = 300;
  Index half = hint, from = kNone;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Vector3d w = weights(half, p);
    if (w.minCoeff() >= 0) return {half, w};
    // Corner i lies across side i + 1; the side that p is farthest beyond comes first.
    Index onward = kNone;
    double least = 0;
    for (int i = 0; i < 3; ++i) {
      const Index other = surface_.neighbour(half, (i + 1) % 3);
      if (w[i] < least && other != kNone && other != from) least = w[i], onward = other;
    }
    if (onward == kNone) break;
    from = half;
    half = onward;
  }
  return nearest(p, half);
}

/// Of the triangles around the hint, those nearest to p first.
Chart::Place Chart::nearest(const Vec2& p, Index hint) const {
  constexpr std::size_t kMost = 200;
  std::set<Index> seen{hint};
  std::priority_queue<std::pair<double, Index>> waiting;  // nearest first
  Place best{hint, closest(p, hint).weights};
  double least = closest(p, hint).distance2;
  waiting.emplace(-least, hint);
  while (!waiting.empty() && least > 0 && seen.size() < kMost) {
    const Index half = waiting.top().second;
    waiting.pop();
    for (int i = 0; i < 3; ++i) {
      const Index other = surface_.neighbour(half, i);
      if (other == kNone || !seen.insert(other).second) continue;
      const space::OnTriangle point = closest(p, other);
      if (point.distance2 < least) least = point.distance2, best = {other, point.weights};
      waiting.emplace(-point.distance2, other);
    }
  }
  return best;
}

Chart::Place Chart::nearest_of_all(const Vec2& p) const {
  Place best;
  double least = std::numeric_limits<double>::infinity();
  for (Index half = 0; half < triangles_.size(); ++half) {
    const space::OnTriangle point = closest(p, half);
    if (point.distance2 < least) least = point.distance2, best = {half, point.weights};
  }
  return best;
}

space::OnTriangle Chart::closest(const Vec2& p, Index half) const {
  const auto& t = triangles_[half];
  return space::closest_on_triangle(in_space(p), in_space(flat()[t[0]]), in_space(flat()[t[1]]),
                                    in_space(flat()[t[2]]));
}

Eigen::Vector3d Chart::to_space(const Place& place) const {
  const auto& t = triangles_[place.half];
  return place.weights[0] * points_[t[0]] + place.weights[1] * points_[t[1]] + place.weights[2] * points_[t[2]];
}

std::vector<Chart::Place> Chart::places(const kernel::Mesh& mesh) const {
  std::vector<Place> places(mesh.vertex_slots(), Place{.half = kNone});
  std::vector<Index> order;
  for (Index v = 0; v < flat().size(); ++v) {
    if (!mesh.is_live_vertex(v) || has_moved(mesh, v)) continue;
    places[v].half = half_at(v);
    for (int i = 0; i < 3; ++i) places[v].weights[i] = triangles_[half_at(v)][i] == v;
    order.push_back(v);
  }
  for (std::size_t k = 0; k < order.size(); ++k)
    for (Index h : mesh.around(order[k]))
      if (const Index v = mesh.target(h); places[v].half == kNone) {
        places[v] = locate(mesh.point(v), places[order[k]].half);
        order.push_back(v);
      }
  return places;
}

Lifted lift(const kernel::Mesh& mesh, const Piece& piece, const Chart& chart, const space::Background& background) {
  Lifted lifted{std::vector<Eigen::Vector3d>(mesh.vertex_slots(), Eigen::Vector3d::Zero()),
                std::vector<Index>(mesh.vertex_slots(), kNone)};
  std::vector<Index> face_of_half(piece.halves.size(), 0);
  for (Index f = 0; f < piece.faces.size(); ++f)
    for (Index h = piece.first_half[f]; h < piece.first_half[f] + degree(piece.faces[f]) - 2; ++h) face_of_half[h] = f;
  const std::vector<Chart::Place> places = chart.places(mesh);
  for (Index v = 0; v < places.size(); ++v) {
    if (places[v].half == kNone) continue;
    if (!chart.has_moved(mesh, v)) {
      lifted.points[v] = piece.points[v];
      lifted.on[v] = piece.on[v];
      continue;
    }
    const space::Foot foot = background.walk(chart.to_space(places[v]), piece.near[face_of_half[places[v].half]]);
    lifted.points[v] = foot.point;
    lifted.on[v] = foot.triangle;
  }
  return lifted;
}

}  // namespace qmorph::chart
