// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/sketch.hpp"

#include <algorithm>
#include <cmath>

namespace qmorph::test {
namespace {

using Eigen::Vector2d;

constexpr double kLattice = 0x1p19;

/// A filling keeps this share of the size away from nodes, and this one from lines.
constexpr double kNodeDistance = 0.6, kLineDistance = 0.35;

LatticePoint to_lattice(const Vector2d& p) { return {std::llround(p.x() * kLattice), std::llround(p.y() * kLattice)}; }

Vector2d to_plane(const LatticePoint& p) { return Vector2d(double(p.x), double(p.y)) / kLattice; }

double distance_to_line(const Vector2d& p, const Vector2d& from, const Vector2d& to) {
  const Vector2d way = to - from;
  const double length2 = way.squaredNorm();
  const double along = length2 > 0 ? std::clamp((p - from).dot(way) / length2, 0.0, 1.0) : 0.0;
  return (p - from - along * way).norm();
}

}  // namespace

double SizeField::at(const Vector2d& p) const {
  if (growth <= 0) return largest;
  return std::min(largest, smallest + growth * distance_to_line(p, from, to));
}

Vector2d Sketch::place(int node) const { return to_plane(nodes_[node]); }

int Sketch::node(const Vector2d& place) {
  const LatticePoint p = to_lattice(place);
  const auto [it, is_new] = node_at_.try_emplace(p, int(nodes_.size()));
  if (is_new) nodes_.push_back(p);
  return it->second;
}

std::vector<int> Sketch::line(int from, int to, SegmentKind kind, int least) {
  const Vector2d start = place(from), way = place(to) - start;
  constexpr int kSamples = 64;
  std::array<double, kSamples + 1> pieces{};  // how many pieces up to each sample
  for (int i = 0; i < kSamples; ++i)
    pieces[i + 1] = pieces[i] + way.norm() / kSamples / size.at(start + way * ((i + 0.5) / kSamples));
  const int count = std::max(least, int(std::lround(pieces[kSamples])));
  std::vector<int> nodes{from};
  for (int k = 1, i = 0; k < count; ++k) {
    const double wanted = pieces[kSamples] * k / count;
    while (pieces[i + 1] < wanted) ++i;
    const double along = (i + (wanted - pieces[i]) / (pieces[i + 1] - pieces[i])) / kSamples;
    nodes.push_back(node(start + along * way));
  }
  nodes.push_back(to);
  for (std::size_t i = 1; i < nodes.size(); ++i) segments_.push_back({nodes[i - 1], nodes[i], kind});
  return nodes;
}

std::vector<int> Sketch::path(const std::vector<Vector2d>& corners, SegmentKind kind, bool closed) {
  std::vector<int> nodes;
  const std::size_t sides = closed ? corners.size() : corners.size() - 1;
  for (std::size_t i = 0; i < sides; ++i) {
    const auto side = line(node(corners[i]), node(corners[(i + 1) % corners.size()]), kind);
    nodes.insert(nodes.end(), side.begin(), side.end() - 1);
  }
  if (!closed) nodes.push_back(node(corners.back()));
  return nodes;
}

/// True if a node of that size here is not too near to what is drawn.
bool Sketch::is_free(const Vector2d& place, double local_size) const {
  for (const LatticePoint& other : nodes_)
    if ((to_plane(other) - place).squaredNorm() < std::pow(kNodeDistance * local_size, 2)) return false;
  for (const Segment& s : segments_)
    if (distance_to_line(place, to_plane(nodes_[s.from]), to_plane(nodes_[s.to])) < kLineDistance * local_size)
      return false;
  return true;
}

/// Adds the nodes of the inside (and of the outside within the bounding box; the triangulation drops those).
void Sketch::fill(Rng& rng, std::vector<LatticePoint>& points) const {
  Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const LatticePoint& p : nodes_) {
    low = low.cwiseMin(to_plane(p));
    high = high.cwiseMax(to_plane(p));
  }
  const auto add = [&](const Vector2d& p) {
    const Vector2d shift(rng.between(-0.5, 0.5), rng.between(-0.5, 0.5));
    const double local = size.at(p);
    const Vector2d place = p + filling.jitter * local * shift;
    const bool inside = (place.array() > low.array()).all() && (place.array() < high.array()).all();
    if (inside && is_free(place, local)) points.push_back(to_lattice(place));
  };
  if (filling.pattern == Filling::Pattern::cells) {  // a quadtree: cells are halved until they have the size
    std::vector<std::pair<Vector2d, double>> cells{{(low + high) / 2, (high - low).maxCoeff()}};
    while (!cells.empty()) {
      const auto [centre, width] = cells.back();
      cells.pop_back();
      if (width <= 1.2 * size.at(centre)) {
        add(centre);
        continue;
      }
      for (const double x : {-0.25, 0.25})
        for (const double y : {-0.25, 0.25}) cells.push_back({centre + width * Vector2d(x, y), width / 2});
    }
  } else if (filling.pattern == Filling::Pattern::rows) {  // rows of equilateral triangles
    const double step = size.largest, reach = (high - low).norm();
    const Vector2d along(std::cos(filling.turn), std::sin(filling.turn)), up(-along.y(), along.x());
    const int rows = int(reach / (step * 0.866)) + 1;
    for (int j = -rows; j <= rows; ++j)
      for (int i = -rows; i <= rows; ++i) add((low + high) / 2 + step * ((i + 0.5 * (j & 1)) * along + 0.866 * j * up));
  }
}

std::optional<Draft> Sketch::build(Rng& rng) const {
  std::vector<LatticePoint> points = nodes_;
  fill(rng, points);
  const auto mesh = triangulate(points, segments_);
  if (!mesh || mesh->triangles.empty()) return std::nullopt;
  Draft draft;
  for (const LatticePoint& p : points) draft.points.push_back(to_plane(p));
  for (const auto& [a, b, c] : mesh->triangles) draft.triangles.push_back({Index(a), Index(b), Index(c)});
  for (const auto& [a, b] : mesh->constraints) draft.constraints.push_back({Index(a), Index(b)});
  for (const int i : fixed_) draft.fixed.push_back(Index(i));
  drop_unused_points(draft);
  return draft;
}

}  // namespace qmorph::test
