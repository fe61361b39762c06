// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/opening.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <span>

#include "chart/topology.hpp"
#include "kernel/is_any.hpp"

namespace qmorph::chart {
namespace {

/// A point inside at which angles lack more than this is the tip of a cone (radians).
constexpr double kTip = 0.7;
/// A corner with a smaller angle in the plane may become one quad.
constexpr double kNarrow = 0.9 * std::numbers::pi;
/// One with a larger angle in space is wider than that in every chart that is good.
constexpr double kNarrowInSpace = 1.3 * std::numbers::pi;

/// Where a path may end: the points of a loop, or a tip.
struct Terminal {
  std::vector<Index> points;
  double size = 0;
};

std::vector<Terminal> terminals_of(const Piece& piece, const std::vector<double>& defects) {
  std::vector<Terminal> terminals;
  std::vector<char> is_outer(piece.points.size(), 0);
  for (std::vector<Index>& loop : loops_of(piece)) {
    Terminal terminal;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      is_outer[loop[k]] = 1;
      terminal.size += (piece.points[loop[(k + 1) % loop.size()]] - piece.points[loop[k]]).norm();
    }
    terminal.points = std::move(loop);
    terminals.push_back(std::move(terminal));
  }
  for (Index v = 0; v < piece.points.size(); ++v)
    if (!is_outer[v] && defects[v] > kTip) terminals.push_back({{v}, -1 / defects[v]});
  std::stable_sort(terminals.begin(), terminals.end(),
                   [](const Terminal& a, const Terminal& b) { return a.size > b.size; });
  return terminals;
}

/// The points at the other ends of edges, by point.
class Neighbours {
 public:
  explicit Neighbours(const Piece& piece) : first_(piece.points.size() + 1, 0) {
    const auto for_sides = [&](const auto& visit) {
      for (const Face& face : piece.faces)
        for (Index i = 0; i < degree(face); ++i) visit(face[i], face[next_corner(face, i)]);
    };
    for_sides([&](Index a, Index b) { ++first_[a], ++first_[b]; });
    std::exclusive_scan(first_.begin(), first_.end(), first_.begin(), Index(0));
    list_.resize(first_.back());
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for_sides([&](Index a, Index b) { list_[next[a]++] = b, list_[next[b]++] = a; });
  }
  std::span<const Index> of(Index v) const { return {list_.data() + first_[v], list_.data() + first_[v + 1]}; }

 private:
  std::vector<Index> first_, list_;
};

class Joining {
 public:
  explicit Joining(const Piece& piece) : piece_(piece), neighbours_(piece) {}

  /// The shortest path from a set of points to another, touching neither in between.
  std::vector<Index> shortest(const std::vector<Index>& from, const std::vector<char>& is_goal) const {
    std::vector<double> distance(piece_.points.size(), std::numeric_limits<double>::infinity());
    std::vector<Index> before(piece_.points.size(), kNone);
    std::priority_queue<std::pair<double, Index>> waiting;  // nearest first
    for (Index v : from) distance[v] = 0, waiting.emplace(0, v);
    while (!waiting.empty()) {
      const auto [negative, v] = waiting.top();
      waiting.pop();
      if (-negative > distance[v]) continue;
      if (is_goal[v] && before[v] != kNone) {
        std::vector<Index> path{v};
        while (before[path.back()] != kNone) path.push_back(before[path.back()]);
        return path;
      }
      for (Index w : neighbours_.of(v)) {
        const double length = distance[v] + (piece_.points[w] - piece_.points[v]).norm();
        if (length < distance[w]) distance[w] = length, before[w] = v, waiting.emplace(-length, w);
      }
    }
    return {};
  }

 private:
  const Piece& piece_;
  const Neighbours neighbours_;
};

}  // namespace

std::vector<std::vector<Index>> opening_paths(const Piece& piece, const std::vector<double>& defects) {
  const std::vector<Terminal> terminals = terminals_of(piece, defects);
  if (terminals.size() < 2) return {};
  const Joining joining(piece);
  std::vector<std::vector<Index>> paths;
  std::vector<char> joined(piece.points.size(), 0);
  for (const Terminal& terminal : terminals) {
    if (&terminal != terminals.data()) {
      std::vector<Index> path = joining.shortest(terminal.points, joined);
      if (path.empty()) continue;
      for (Index v : path) joined[v] = 1;
      paths.push_back(std::move(path));
    }
    for (Index v : terminal.points) joined[v] = 1;
  }
  return paths;
}

bool may_have_narrow_tip(const Piece& piece) {
  std::vector<char> is_tip(piece.points.size(), 0);
  for (const std::vector<Index>& loop : loops_of(piece))
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (piece.node[loop[(k + loop.size() - 1) % loop.size()]] == piece.node[loop[(k + 1) % loop.size()]])
        is_tip[loop[k]] = 1;
  if (!is_any(is_tip)) return false;
  const std::vector<double> defects = angle_defects(piece);
  for (Index v = 0; v < is_tip.size(); ++v)
    if (is_tip[v] && std::numbers::pi - defects[v] < kNarrowInSpace) return true;
  return false;
}

std::vector<Index> path_from_narrow_tip(const Piece& piece, const std::vector<Vec2>& flat) {
  std::vector<double> angles(piece.points.size(), 0);
  for (const auto& t : piece.halves)
    for (int i = 0; i < 3; ++i)
      angles[t[i]] += std::abs(signed_angle(flat[t[(i + 1) % 3]] - flat[t[i]], flat[t[(i + 2) % 3]] - flat[t[i]]));
  for (const std::vector<Index>& loop : loops_of(piece))
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Index tip = loop[k], after = loop[(k + 1) % loop.size()],
                  before = loop[(k + loop.size() - 1) % loop.size()];
      if (piece.node[before] != piece.node[after] || angles[tip] > kNarrow) continue;
      // To the point of the boundary that lies straight ahead.
      const Vec2 ahead = rotated(flat[after] - flat[tip], 0.5 * angles[tip]).normalized();
      std::vector<char> is_goal(piece.points.size(), 0);
      double best = -1;
      Index goal = kNone;
      for (const auto& other : loops_of(piece))
        for (Index v : other) {
          const double along = (flat[v] - flat[tip]).normalized().dot(ahead);
          if (v != tip && along > best) best = along, goal = v;
        }
      is_goal[goal] = 1;
      return Joining(piece).shortest({tip}, is_goal);
    }
  return {};
}

}  // namespace qmorph::chart
