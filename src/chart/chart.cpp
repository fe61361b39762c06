// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/chart.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <set>

namespace qmorph::chart {
namespace {

Eigen::Vector3d in_space(const Vec2& p) { return {p.x(), p.y(), 0}; }

}  // namespace

Chart::Chart(const Piece& piece, int rounds)
    : piece_(piece),
      barriers_(piece.barriers()),
      surface_(piece.points, piece.halves, barriers_),
      flattening_(flatten(surface_, piece.points.size(), rounds)),
      half_at_(piece.points.size(), kNone) {
  for (Index t = 0; t < piece.halves.size(); ++t)
    for (Index v : piece.halves[t]) half_at_[v] = t;
}

Eigen::Vector3d Chart::weights(Index half, const Vec2& p) const {
  const auto& t = piece_.halves[half];
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
  for (Index half = 0; half < piece_.halves.size(); ++half) {
    const space::OnTriangle point = closest(p, half);
    if (point.distance2 < least) least = point.distance2, best = {half, point.weights};
  }
  return best;
}

space::OnTriangle Chart::closest(const Vec2& p, Index half) const {
  const auto& t = piece_.halves[half];
  return space::closest_on_triangle(in_space(p), in_space(flat()[t[0]]), in_space(flat()[t[1]]),
                                    in_space(flat()[t[2]]));
}

Eigen::Vector3d Chart::to_space(const Place& place) const {
  const auto& t = piece_.halves[place.half];
  return place.weights[0] * piece_.points[t[0]] + place.weights[1] * piece_.points[t[1]] +
         place.weights[2] * piece_.points[t[2]];
}

Lifted lift(const kernel::Mesh& mesh, const Piece& piece, const Chart& chart, const space::Background& background) {
  Lifted lifted{std::vector<Eigen::Vector3d>(mesh.vertex_slots(), Eigen::Vector3d::Zero()),
                std::vector<Index>(mesh.vertex_slots(), kNone)};
  std::vector<Index> half(mesh.vertex_slots(), kNone), face_of_half(piece.halves.size(), 0), order;
  for (Index f = 0; f < piece.faces.size(); ++f)
    for (Index h = piece.first_half[f]; h < piece.first_half[f] + degree(piece.faces[f]) - 2; ++h) face_of_half[h] = f;
  for (Index v = 0; v < piece.points.size(); ++v) {
    if (!mesh.is_live_vertex(v) || mesh.point(v) != chart.flat()[v]) continue;
    half[v] = chart.half_at(v);
    lifted.points[v] = piece.points[v];
    lifted.on[v] = piece.on[v];
    order.push_back(v);
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (Index h : mesh.around(order[k])) {
      const Index v = mesh.target(h);
      if (half[v] == kNone) {
        const Chart::Place place = chart.locate(mesh.point(v), half[order[k]]);
        const space::Foot foot = background.walk(chart.to_space(place), piece.near[face_of_half[place.half]]);
        half[v] = place.half;
        lifted.points[v] = foot.point;
        lifted.on[v] = foot.triangle;
        order.push_back(v);
      }
    }
  }
  return lifted;
}

}  // namespace qmorph::chart
