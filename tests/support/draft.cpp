// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/draft.hpp"

#include <algorithm>
#include <map>

namespace qmorph::test {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double flatness(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double longest2 = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest2 > 0 ? cross(b - a, c - a) / longest2 : 0;
}

double worst_flatness(const Draft& draft) {
  double worst = 1;
  for (const auto& [a, b, c] : draft.triangles)
    worst = std::min(worst, flatness(draft.points[a], draft.points[b], draft.points[c]));
  return worst;
}

double smallest_sine(const std::array<Vector2d, 4>& p) {
  double smallest = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d ahead = p[(i + 1) % 4] - p[i], behind = p[(i + 3) % 4] - p[i];
    smallest = std::min(smallest, cross(ahead, behind) / (ahead.norm() * behind.norm()));
  }
  return smallest;
}

double smallest_sine(const std::vector<Eigen::Vector3d>& points, std::span<const std::array<Index, 4>> quads) {
  double smallest = 1;
  for (const auto& quad : quads) {
    std::array<Vector2d, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = points[quad[i]].head<2>();
    smallest = std::min(smallest, smallest_sine(corners));
  }
  return smallest;
}

std::vector<DraftEdge> edges_of(const Draft& draft) {
  std::vector<DraftEdge> sides;
  for (Index t = 0; t < draft.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& nodes = draft.triangles[t];
      const Index from = nodes[i], to = nodes[(i + 1) % 3];
      DraftEdge side{.a = std::min(from, to), .b = std::max(from, to)};
      side.triangle[from < to ? 0 : 1] = t;
      side.apex[from < to ? 0 : 1] = nodes[(i + 2) % 3];
      sides.push_back(side);
    }
  std::sort(sides.begin(), sides.end(),
            [](const DraftEdge& l, const DraftEdge& r) { return std::pair(l.a, l.b) < std::pair(r.a, r.b); });
  std::vector<DraftEdge> edges;
  for (const DraftEdge& side : sides) {
    if (edges.empty() || edges.back().a != side.a || edges.back().b != side.b) {
      edges.push_back(side);
      continue;
    }
    for (std::size_t i = 0; i < 2; ++i)
      if (side.triangle[i] != kNone) {
        edges.back().triangle[i] = side.triangle[i];
        edges.back().apex[i] = side.apex[i];
      }
  }
  return edges;
}

std::vector<char> boundary_nodes(const Draft& draft) {
  std::map<std::pair<Index, Index>, int> elements;
  const auto count = [&](const auto& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) ++elements[std::minmax(nodes[i], nodes[(i + 1) % nodes.size()])];
  };
  for (const auto& t : draft.triangles) count(t);
  for (const auto& q : draft.quads) count(q);
  std::vector<char> boundary(draft.points.size(), 0);
  for (const auto& [edge, sides] : elements)
    if (sides == 1) boundary[edge.first] = boundary[edge.second] = 1;
  return boundary;
}

void drop_unused_points(Draft& draft) {
  std::vector<Index> row(draft.points.size(), kNone);
  const auto mark = [&](const auto& elements) {
    for (const auto& nodes : elements)
      for (const Index i : nodes) row[i] = 0;
  };
  mark(draft.triangles);
  mark(draft.quads);
  std::vector<Vector2d> kept;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == kNone) continue;
    row[i] = Index(kept.size());
    kept.push_back(draft.points[i]);
  }
  draft.points = std::move(kept);
  const auto renumber = [&](auto& elements) {
    for (auto& nodes : elements)
      for (Index& i : nodes) i = row[i];
  };
  renumber(draft.triangles);
  renumber(draft.quads);
  std::erase_if(draft.constraints, [&](const auto& c) { return row[c[0]] == kNone || row[c[1]] == kNone; });
  renumber(draft.constraints);
  std::erase_if(draft.fixed, [&](Index i) { return row[i] == kNone; });
  for (Index& i : draft.fixed) i = row[i];
}

void keep_triangles(Draft& draft, const std::vector<char>& keep) {
  std::vector<std::array<Index, 3>> kept;
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t]) kept.push_back(draft.triangles[t]);
  draft.triangles = std::move(kept);
  drop_unused_points(draft);
}

void keep_largest_part(const Draft& draft, std::vector<char>& keep) {
  std::vector<std::vector<Index>> neighbours(draft.triangles.size());
  for (const DraftEdge& e : edges_of(draft))
    if (!e.on_boundary() && keep[e.triangle[0]] && keep[e.triangle[1]]) {
      neighbours[e.triangle[0]].push_back(e.triangle[1]);
      neighbours[e.triangle[1]].push_back(e.triangle[0]);
    }
  std::vector<int> part(draft.triangles.size(), -1);
  std::vector<std::size_t> sizes;
  for (Index first = 0; first < part.size(); ++first) {
    if (!keep[first] || part[first] >= 0) continue;
    std::vector<Index> queue{first};
    part[first] = int(sizes.size());
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (const Index t : neighbours[queue[k]])
        if (part[t] < 0) {
          part[t] = part[first];
          queue.push_back(t);
        }
    sizes.push_back(queue.size());
  }
  if (sizes.empty()) return;
  const int largest = int(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = keep[t] && part[t] == largest;
}

}  // namespace qmorph::test
