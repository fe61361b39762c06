// SPDX-License-Identifier: GPL-2.0-or-later
#include "sheets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace benchmark {
namespace {

using qmorph::kNone;

Vector2d at(const Patch& patch, Index v) { return patch.points[v].head<2>(); }

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

void add_points(Patch& patch, const std::vector<Vector2d>& points) {
  for (const Vector2d& p : points) patch.points.emplace_back(p.x(), p.y(), 0);
}

/// Smallest height over longest side, negative if clockwise.
double flatness(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return cross(b - a, c - a) / longest;
}

/// Positive if d lies inside the circle through a, b, c.
double in_circle(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const Vector2d p = a - d, q = b - d, r = c - d;
  return p.squaredNorm() * cross(q, r) + q.squaredNorm() * cross(r, p) + r.squaredNorm() * cross(p, q);
}

/// Inserts points one after another and flips edges until all are locally Delaunay. [Lawson77]
class Delaunay {
 public:
  explicit Delaunay(const std::vector<Vector2d>& points) : points_(points) {
    Vector2d low = points[0], high = points[0];
    for (const Vector2d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const Vector2d middle = (low + high) / 2;
    const double far = 1000 * (high - low).norm();
    for (const Vector2d& way : {Vector2d(-1, -1), Vector2d(1, -1), Vector2d(0, 1)})
      points_.push_back(middle + far * way);
    const auto n = Index(points.size());
    add({n, n + 1, n + 2}, {kNone, kNone, kNone});
    for (Index v = 0; v < n; ++v) insert(v);
  }

  std::vector<std::array<Index, 3>> triangles() const {
    std::vector<std::array<Index, 3>> inside;
    for (const auto& t : nodes_)
      if (std::all_of(t.begin(), t.end(), [&](Index v) { return v + 3 < points_.size(); })) inside.push_back(t);
    return inside;
  }

 private:
  using Three = std::array<Index, 3>;

  Index add(const Three& nodes, const Three& beyond) {
    nodes_.push_back(nodes), beyond_.push_back(beyond);
    return Index(nodes_.size() - 1);
  }
  void replace_neighbour(Index t, Index old, Index by) {
    if (t != kNone) *std::find(beyond_[t].begin(), beyond_[t].end(), old) = by;
  }

  Index locate(const Vector2d& p) const {
    Index t = last_;
    for (bool moved = true; moved;) {
      moved = false;
      for (int i = 0; i < 3 && !moved; ++i) {
        const Vector2d &a = points_[nodes_[t][i]], &b = points_[nodes_[t][(i + 1) % 3]];
        if (cross(b - a, p - a) < 0 && beyond_[t][i] != kNone) t = beyond_[t][i], moved = true;
      }
    }
    return t;
  }

  void insert(Index v) {
    const Index t = locate(points_[v]);
    const auto [a, b, c] = nodes_[t];
    const auto [x, y, z] = beyond_[t];  // beyond ab, bc, ca
    const Index u = add({b, c, v}, {y, kNone, t}), w = add({c, a, v}, {z, t, u});
    beyond_[u][1] = w;
    nodes_[t] = {a, b, v}, beyond_[t] = {x, u, w};
    replace_neighbour(y, t, u), replace_neighbour(z, t, w);
    last_ = t;
    for (const Index s : {t, u, w}) waiting_.push_back(s);
    while (!waiting_.empty()) {
      const Index s = waiting_.back();
      waiting_.pop_back();
      legalise(s, v);
    }
  }

  /// Turns the edge of t across from v if the node behind it is in the circle.
  void legalise(Index t, Index v) {
    const auto i = Index(std::find(nodes_[t].begin(), nodes_[t].end(), v) - nodes_[t].begin());
    const Index side = (i + 1) % 3, s = beyond_[t][side];
    if (s == kNone) return;
    const auto j = Index(std::find(beyond_[s].begin(), beyond_[s].end(), t) - beyond_[s].begin());
    const Index a = nodes_[t][side], b = nodes_[t][(side + 1) % 3], d = nodes_[s][(j + 2) % 3];
    if (!(in_circle(points_[v], points_[a], points_[b], points_[d]) > 0)) return;
    const Index at_a = beyond_[t][(side + 2) % 3], at_b = beyond_[t][(side + 1) % 3];
    const Index behind_a = beyond_[s][(j + 1) % 3], behind_b = beyond_[s][(j + 2) % 3];
    nodes_[t] = {v, a, d}, beyond_[t] = {at_a, behind_a, s};
    nodes_[s] = {v, d, b}, beyond_[s] = {t, behind_b, at_b};
    replace_neighbour(behind_a, s, t), replace_neighbour(at_b, t, s);
    waiting_.push_back(t), waiting_.push_back(s);
  }

  std::vector<Vector2d> points_;
  std::vector<Three> nodes_, beyond_;  ///< triangles, and those beyond their sides
  std::vector<Index> waiting_;
  Index last_ = 0;
};

}  // namespace

std::vector<Vector2d> row(double y, double width, int edges) {
  std::vector<Vector2d> nodes;
  for (int i = 0; i <= edges; ++i) nodes.emplace_back(width * i / edges, y);
  return nodes;
}

Patch zip(const std::vector<std::vector<Vector2d>>& rows) {
  Patch patch;
  Index low = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto before = Index(patch.points.size());
    add_points(patch, rows[r]);
    if (r == 0) continue;
    Index high = before;
    const Index low_end = before - 1, high_end = Index(patch.points.size()) - 1;
    while (low < low_end || high < high_end) {
      const bool is_low_next = high == high_end || (low < low_end && (at(patch, low + 1) - at(patch, high)).norm() <
                                                                         (at(patch, high + 1) - at(patch, low)).norm());
      const Index next = is_low_next ? low + 1 : high + 1;
      patch.triangles.push_back({low, next, high});
      (is_low_next ? low : high) = next;
    }
    low = before;
  }
  return patch;
}

Patch grid(int columns, int rows) {
  Patch patch;
  for (int r = 0; r <= rows; ++r) add_points(patch, row(r, columns, columns));
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const Index a = Index(r * (columns + 1) + c), b = a + 1, d = a + Index(columns) + 1;
      patch.triangles.push_back({a, b, d + 1});
      patch.triangles.push_back({a, d + 1, d});
    }
  return patch;
}

Patch lattice(int columns, int rows, double jitter, Random& random) {
  const double height = std::sqrt(3.0) / 2;
  std::vector<std::vector<Vector2d>> nodes;
  for (int r = 0; r <= rows; ++r) {
    nodes.push_back(row(r * height, columns, columns));
    if (r % 2 == 1) {
      for (Vector2d& p : nodes.back()) p.x() -= 0.5;
      nodes.back().front().x() = 0;
      nodes.back().emplace_back(columns, r * height);
    }
    if (r == 0 || r == rows) continue;
    for (std::size_t i = 1; i + 1 < nodes.back().size(); ++i)
      nodes.back()[i] += Vector2d(random.between(-jitter, jitter), random.between(-jitter, jitter));
  }
  return zip(nodes);
}

Patch delaunay(const std::vector<Vector2d>& points) {
  Patch patch;
  add_points(patch, points);
  patch.triangles = Delaunay(points).triangles();
  return patch;
}

void map_points(Patch& patch, const std::function<Vector2d(const Vector2d&)>& to) {
  for (auto& p : patch.points) p.head<2>() = to(p.head<2>());
}

void keep_triangles(Patch& patch, const std::function<bool(const Vector2d&)>& is_kept) {
  std::vector<Index> part;
  for (const auto& t : patch.triangles)
    part.push_back(is_kept((at(patch, t[0]) + at(patch, t[1]) + at(patch, t[2])) / 3) ? 0 : 1);
  patch = split(patch, part, 2)[0];
}

std::vector<InnerEdge> inner_edges(const Patch& patch) {
  struct Side {
    Index low, high, triangle, corner;
  };
  std::vector<Side> sides;
  for (Index t = 0; t < patch.triangles.size(); ++t)
    for (Index i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(patch.triangles[t][i], patch.triangles[t][(i + 1) % 3]);
      sides.push_back({low, high, t, i});
    }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& a, const Side& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  std::vector<InnerEdge> edges;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &one = sides[i], &two = sides[i + 1];
    if (one.low != two.low || one.high != two.high) continue;
    const auto &t = patch.triangles[one.triangle], &u = patch.triangles[two.triangle];
    edges.push_back({t[one.corner], t[(one.corner + 1) % 3], t[(one.corner + 2) % 3], u[(two.corner + 2) % 3],
                     one.triangle, two.triangle});
  }
  return edges;
}

std::vector<Index> inner_nodes(const Patch& patch) {
  std::vector<int> balance(patch.points.size(), 0);  // triangles minus inner edges: 0 where they close around a node
  for (const auto& t : patch.triangles)
    for (const Index v : t) ++balance[v];
  for (const InnerEdge& edge : inner_edges(patch)) --balance[edge.a], --balance[edge.b];
  std::vector<Index> nodes;
  for (Index v = 0; v < balance.size(); ++v)
    if (balance[v] == 0) nodes.push_back(v);
  return nodes;
}

void turn_edges(Patch& patch, double share, double flattest, Random& random) {
  std::vector<char> changed(patch.triangles.size(), 0);
  for (const InnerEdge& e : inner_edges(patch)) {
    if (!random.chance(share) || changed[e.left_triangle] || changed[e.right_triangle]) continue;
    const Vector2d a = at(patch, e.a), b = at(patch, e.b), c = at(patch, e.left), d = at(patch, e.right);
    if (flatness(a, d, c) < flattest || flatness(d, b, c) < flattest) continue;
    patch.triangles[e.left_triangle] = {e.a, e.right, e.left};
    patch.triangles[e.right_triangle] = {e.right, e.b, e.left};
    changed[e.left_triangle] = changed[e.right_triangle] = 1;
  }
}

std::vector<Patch> split(const Patch& patch, const std::vector<Index>& part_of, Index parts) {
  std::vector<Patch> result(parts);
  std::vector<std::vector<Index>> members(parts);
  for (Index t = 0; t < part_of.size(); ++t) members[part_of[t]].push_back(t);
  std::vector<Index> place(patch.points.size(), kNone);
  for (Index p = 0; p < parts; ++p) {
    std::vector<Index> used;
    for (const Index t : members[p]) {
      auto nodes = patch.triangles[t];
      for (Index& v : nodes) {
        if (place[v] == kNone) {
          place[v] = Index(used.size());
          used.push_back(v);
          result[p].points.push_back(patch.points[v]);
        }
        v = place[v];
      }
      result[p].triangles.push_back(nodes);
    }
    for (const Index v : used) place[v] = kNone;
  }
  return result;
}

}  // namespace benchmark
