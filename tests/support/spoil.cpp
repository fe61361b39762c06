// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/spoil.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace qmorph::test {
namespace {

using Eigen::Vector2d;

std::set<std::pair<Index, Index>> constraint_set(const Draft& draft) {
  std::set<std::pair<Index, Index>> set;
  for (const auto& [a, b] : draft.constraints) set.insert(std::minmax(a, b));
  return set;
}

void add_constraint(Draft& draft, std::set<std::pair<Index, Index>>& known, Index a, Index b) {
  if (known.insert(std::minmax(a, b)).second) draft.constraints.push_back({a, b});
}

double flatness_of(const Draft& draft, const std::array<Index, 3>& t) {
  return flatness(draft.points[t[0]], draft.points[t[1]], draft.points[t[2]]);
}

Vector2d centre(const Draft& draft, std::size_t t) {
  const auto& [a, b, c] = draft.triangles[t];
  return (draft.points[a] + draft.points[b] + draft.points[c]) / 3;
}

std::vector<std::vector<Index>> triangles_at_nodes(const Draft& draft) {
  std::vector<std::vector<Index>> at(draft.points.size());
  for (Index t = 0; t < draft.triangles.size(); ++t)
    for (const Index i : draft.triangles[t]) at[i].push_back(t);
  return at;
}

}  // namespace

void jitter_nodes(Draft& draft, Rng& rng, double amount, double flattest) {
  const auto boundary = boundary_nodes(draft);
  const auto at = triangles_at_nodes(draft);
  for (std::size_t i = 0; i < draft.points.size(); ++i) {
    if (boundary[i]) continue;
    double nearest = 1e300, worst = flattest;
    for (const Index t : at[i]) {
      worst = std::min(worst, flatness_of(draft, draft.triangles[t]));
      for (const Index j : draft.triangles[t])
        if (j != i) nearest = std::min(nearest, (draft.points[j] - draft.points[i]).norm());
    }
    const Vector2d home = draft.points[i];
    Vector2d step = amount * nearest * Vector2d(rng.between(-1, 1), rng.between(-1, 1));
    for (int attempt = 0; attempt < 4; ++attempt, step /= 2) {
      draft.points[i] = home + step;
      const bool good = std::all_of(at[i].begin(), at[i].end(),
                                    [&](Index t) { return flatness_of(draft, draft.triangles[t]) >= worst; });
      if (good) break;
      draft.points[i] = home;
    }
  }
}

void flip_edges(Draft& draft, Rng& rng, double share, double flattest) {
  const auto constraints = constraint_set(draft);
  std::vector<char> touched(draft.triangles.size(), 0);  // one flip for a triangle and pass
  for (const DraftEdge& e : edges_of(draft)) {
    if (e.on_boundary() || constraints.contains({e.a, e.b}) || !rng.chance(share)) continue;
    const auto [left, right] = e.triangle;
    if (touched[left] || touched[right]) continue;
    const std::array<Index, 3> first{e.apex[0], e.apex[1], e.b}, second{e.apex[1], e.apex[0], e.a};
    if (e.apex[0] == e.apex[1]) continue;
    if (std::min(flatness_of(draft, first), flatness_of(draft, second)) < flattest) continue;
    draft.triangles[left] = first;
    draft.triangles[right] = second;
    touched[left] = touched[right] = 1;
  }
}

void add_constraint_walks(Draft& draft, Rng& rng, int walks) {
  std::vector<std::vector<Index>> neighbours(draft.points.size());
  for (const DraftEdge& e : edges_of(draft)) {
    neighbours[e.a].push_back(e.b);
    neighbours[e.b].push_back(e.a);
  }
  auto known = constraint_set(draft);
  for (int walk = 0; walk < walks; ++walk) {
    Index here = Index(rng.below(draft.points.size()));
    Vector2d direction(rng.between(-1, 1), rng.between(-1, 1));
    const double wobble = rng.between(0, 1.5);
    for (int steps = rng.range(1, 25); steps > 0 && !neighbours[here].empty(); --steps) {
      Index best = neighbours[here][0];
      double best_score = -1e300;
      for (const Index next : neighbours[here]) {
        const Vector2d way = (draft.points[next] - draft.points[here]).normalized();
        const double score = way.dot(direction) / direction.norm() + rng.between(0, wobble);
        if (score > best_score) {
          best = next;
          best_score = score;
        }
      }
      add_constraint(draft, known, here, best);
      here = best;
    }
  }
}

void add_constraint_loop(Draft& draft, Rng& rng) {
  if (draft.triangles.empty()) return;
  const Vector2d middle = centre(draft, rng.below(draft.triangles.size()));
  std::vector<double> distance(draft.triangles.size());
  for (std::size_t t = 0; t < distance.size(); ++t) distance[t] = (centre(draft, t) - middle).norm();
  std::vector<double> sorted = distance;
  std::sort(sorted.begin(), sorted.end());
  const double radius = sorted[rng.below(sorted.size() / 2 + 1)];
  auto known = constraint_set(draft);
  for (const DraftEdge& e : edges_of(draft)) {
    if (e.on_boundary()) continue;
    if ((distance[e.triangle[0]] <= radius) != (distance[e.triangle[1]] <= radius))
      add_constraint(draft, known, e.a, e.b);
  }
}

void add_material_borders(Draft& draft, Rng& rng, int lines) {
  auto known = constraint_set(draft);
  for (int line = 0; line < lines; ++line) {
    const Vector2d on = centre(draft, rng.below(draft.triangles.size()));
    const Vector2d normal(rng.between(-1, 1), rng.between(-1, 1));
    const auto side = [&](Index t) { return normal.dot(centre(draft, t) - on) < 0; };
    for (const DraftEdge& e : edges_of(draft))
      if (!e.on_boundary() && side(e.triangle[0]) != side(e.triangle[1])) add_constraint(draft, known, e.a, e.b);
  }
}

void add_boundary_constraints(Draft& draft) {
  auto known = constraint_set(draft);
  for (const DraftEdge& e : edges_of(draft))
    if (e.on_boundary()) add_constraint(draft, known, e.a, e.b);
}

void fix_nodes(Draft& draft, Rng& rng, int count) {
  const auto boundary = boundary_nodes(draft);
  std::vector<Index> inner;
  for (Index i = 0; i < draft.points.size(); ++i)
    if (!boundary[i] && std::find(draft.fixed.begin(), draft.fixed.end(), i) == draft.fixed.end()) inner.push_back(i);
  rng.shuffle(inner);
  inner.resize(std::min(inner.size(), std::size_t(count)));
  draft.fixed.insert(draft.fixed.end(), inner.begin(), inner.end());
}

void make_quads(Draft& draft, Rng& rng) {
  constexpr double kSmallestSine = 0.1;
  const auto constraints = constraint_set(draft);
  std::vector<DraftEdge> edges = edges_of(draft);
  rng.shuffle(edges);
  const bool everywhere = rng.chance(0.5);
  const double share = rng.between(0.02, 0.4);
  const Vector2d middle = centre(draft, rng.below(draft.triangles.size()));
  double reach = 0;
  for (const Vector2d& p : draft.points) reach = std::max(reach, (p - middle).norm());
  const double radius = reach * rng.between(0.1, 0.6);

  std::vector<char> keep(draft.triangles.size(), 1);
  std::size_t left = keep.size();
  for (const DraftEdge& e : edges) {
    if (left <= 3) break;
    if (e.on_boundary() || constraints.contains({e.a, e.b})) continue;
    const auto [t, u] = e.triangle;
    if (!keep[t] || !keep[u]) continue;
    const bool wanted = everywhere ? rng.chance(share) : (centre(draft, t) - middle).norm() < radius;
    const std::array<Index, 4> quad{e.a, e.apex[1], e.b, e.apex[0]};
    const std::array<Vector2d, 4> corners{draft.points[quad[0]], draft.points[quad[1]], draft.points[quad[2]],
                                          draft.points[quad[3]]};
    if (!wanted || smallest_sine(corners) < kSmallestSine) continue;
    draft.quads.push_back(quad);
    keep[t] = keep[u] = 0;
    left -= 2;
  }
  std::vector<std::array<Index, 3>> kept;
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t]) kept.push_back(draft.triangles[t]);
  draft.triangles = std::move(kept);
}

}  // namespace qmorph::test
