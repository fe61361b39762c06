// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/layer_builder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace qmorph::test {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
/// The smallest sine of a corner of a layer's cell, and the flattest triangle beside layers.
constexpr double kLeastSine = 0.34, kFlattest = 0.02;

Vector2d turned(const Vector2d& v, double angle) { return Eigen::Rotation2Dd(angle) * v; }
Vector2d left_of(const Vector2d& from, const Vector2d& to) { return turned((to - from).normalized(), kPi / 2); }

std::pair<double, double> key(const Vector2d& p) { return {p.x(), p.y()}; }

}  // namespace

void LayerBuilder::add_line(const Vector2d& foot, const Vector2d& direction, const std::vector<double>& heights,
                            bool still) {
  std::vector<Index> nodes;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    Vector2d place = foot + heights[k] * direction;
    if ((k > 0 || !has_wall_) && !still) {
      const double below = k > 0 ? heights[k] - heights[k - 1] : spacing_;
      const double above = k + 1 < heights.size() ? heights[k + 1] - heights[k] : spacing_;
      const double most = jitter * std::min({below, above, spacing_});
      place += most * Vector2d(rng_.between(-1, 1), rng_.between(-1, 1));
    }
    const auto shared = k == 0 ? foot_.try_emplace(key(place), Index(points_.size())).first : foot_.end();
    nodes.push_back(shared == foot_.end() ? Index(points_.size()) : shared->second);
    if (nodes.back() == points_.size()) points_.push_back(place);
  }
  lines_.push_back(nodes);
  rows_.push_back(heights.size() - 1);
}

std::vector<Vector2d> LayerBuilder::outer_rim(std::size_t first) const {
  std::vector<Vector2d> rim;
  const std::size_t last = is_closed_ ? first + lines_.size() : lines_.size();
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t line = i % lines_.size();
    const bool has_right = is_closed_ || line > 0, has_left = is_closed_ || line + 1 < lines_.size();
    const std::size_t right = (line + lines_.size() - 1) % lines_.size();
    std::size_t k = has_right ? rows_[right] : rows_[line];
    const std::size_t end = has_left ? rows_[line] : rows_[right];
    for (;; k < end ? ++k : --k) {
      rim.push_back(points_[lines_[line][k]]);
      if (k == end) break;
    }
  }
  return rim;
}

std::vector<Vector2d> LayerBuilder::inner_rim() const {
  std::vector<Vector2d> rim;
  for (const auto& line : lines_)
    if (rim.empty() || rim.back() != points_[line[0]]) rim.push_back(points_[line[0]]);
  return rim;
}

std::vector<Vector2d> LayerBuilder::whole_rim() const {
  std::vector<Vector2d> rim = outer_rim(), feet = inner_rim();
  for (std::size_t k = rows_[lines_.size() - 2]; k-- > 1;) rim.push_back(points_[lines_.back()[k]]);
  rim.insert(rim.end(), feet.rbegin(), feet.rend());
  for (std::size_t k = 1; k < rows_[0]; ++k) rim.push_back(points_[lines_[0][k]]);
  return rim;
}

bool LayerBuilder::starts_falling(std::size_t line, std::size_t row) const {
  switch (diagonals) {
    case Diagonals::rising:
      return false;
    case Diagonals::falling:
      return true;
    case Diagonals::alternating:
      return (line + row) % 2 == 0;
    case Diagonals::random:
      break;
  }
  return rng_.chance(0.5);
}

void LayerBuilder::make_cells(LayeredDomain& domain) const {
  for (std::size_t i = 0; i < bands(); ++i) {
    const auto &right = lines_[i], &left = lines_[following(i)];
    for (std::size_t k = 0; k < rows_[i]; ++k) {
      const Index a = right[k], b = left[k], c = left[k + 1], d = right[k + 1];
      if (a == b) {
        domain.patch.triangles.push_back({a, c, d});
        ++domain.tip_triangles;
        continue;
      }
      if (k == 0 && has_wall_ && marks_walls) domain.patch.constraints.push_back({a, b});
      if (k == 0 && has_wall_) domain.wall_quads.push_back(Index(domain.quads.size()));
      domain.quads.push_back({a, b, c, d});
      if (starts_falling(i, k))
        domain.patch.triangles.insert(domain.patch.triangles.end(), {{a, b, d}, {b, c, d}});
      else
        domain.patch.triangles.insert(domain.patch.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  }
}

/// Rims are moved to where the drawing has them, which is a lattice.
bool LayerBuilder::join(const Sketch& around, LayeredDomain& domain) {
  Sketch sketch = around;
  const std::size_t nodes = sketch.node_count();
  std::map<std::pair<double, double>, Index> here;
  for (Index i = 0; i < points_.size(); ++i) {
    const int node = sketch.node(points_[i]);
    if (std::size_t(node) < nodes && here.try_emplace(key(sketch.place(node)), i).second)
      points_[i] = sketch.place(node);
  }
  const auto draft = around.build(rng_);
  if (!draft || worst_flatness(*draft) < kFlattest) return false;
  std::vector<Index> number;
  for (const Vector2d& p : draft->points) {
    const auto found = here.find(key(p));
    number.push_back(found == here.end() ? Index(points_.size()) : found->second);
    if (found == here.end()) points_.push_back(p);
  }
  for (const auto& [a, b, c] : draft->triangles) domain.patch.triangles.push_back({number[a], number[b], number[c]});
  for (const auto& [a, b] : draft->constraints) domain.patch.constraints.push_back({number[a], number[b]});
  return true;
}

std::optional<LayeredDomain> LayerBuilder::build(const Sketch* around) {
  LayeredDomain domain;
  make_cells(domain);
  if (around && !join(*around, domain)) return std::nullopt;
  for (const auto& [a, b, c, d] : domain.quads)
    if (smallest_sine({points_[a], points_[b], points_[c], points_[d]}) < kLeastSine) return std::nullopt;
  for (const auto& [a, b, c] : domain.patch.triangles)
    if (cross(points_[b] - points_[a], points_[c] - points_[a]) <= 0) return std::nullopt;
  // Lines that are longer than the rows on both sides have nodes that nothing uses.
  std::vector<Index> number(points_.size(), kNone);
  const auto use = [&](Index& i) {
    if (number[i] == kNone) {
      number[i] = Index(domain.patch.points.size());
      domain.patch.points.emplace_back(points_[i].x(), points_[i].y(), 0);
    }
    i = number[i];
  };
  for (auto& t : domain.patch.triangles) std::for_each(t.begin(), t.end(), use);
  for (auto& q : domain.quads) std::for_each(q.begin(), q.end(), use);
  for (auto& c : domain.patch.constraints) std::for_each(c.begin(), c.end(), use);
  return domain;
}

void add_wall(LayerBuilder& builder, const std::vector<Vector2d>& nodes, bool closed,
              const std::vector<double>& heights, double fan_from, Rng& rng) {
  const std::size_t n = nodes.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d &before = nodes[(i + n - 1) % n], &here = nodes[i], &after = nodes[(i + 1) % n];
    if (!closed && (i == 0 || i + 1 == n)) {
      builder.add_line(here, i == 0 ? left_of(here, after) : left_of(before, here), heights, true);
      continue;
    }
    const Vector2d first = left_of(before, here), second = left_of(here, after);
    double turn = std::atan2(-cross(first, second), first.dot(second));       // to the right
    if ((before - after).norm() < 1e-9 * (before - here).norm()) turn = kPi;  // round the end of a plate
    if (turn > fan_from) {
      const int wedges = std::max(2, int(std::ceil(turn / rng.between(0.4, 1.1))));
      for (int k = 0; k <= wedges; ++k) builder.add_line(here, turned(first, -turn * k / wedges), heights);
    } else {
      builder.add_line(here, turned(first, -turn / 2) / std::cos(turn / 2), heights);
    }
  }
  if (closed) builder.close();
}

}  // namespace qmorph::test
