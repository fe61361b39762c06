// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/triangulate.hpp"

#include <algorithm>
#include <deque>

namespace qmorph::test {
namespace {

__extension__ typedef __int128 Wide;

/// Positive if d is inside the circle through a, b, c (counter-clockwise).
int in_circle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
  const std::int64_t ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  const Wide value = Wide(ax * ax + ay * ay) * (bx * cy - by * cx) - Wide(bx * bx + by * by) * (ax * cy - ay * cx) +
                     Wide(cx * cx + cy * cy) * (ax * by - ay * bx);
  return (value > 0) - (value < 0);
}

/// Edge i of a triangle goes from node[i] to node[i + 1]; beyond it is across[i]; kind[i] are its SegmentKind bits.
struct Triangle {
  std::array<int, 3> node{};
  std::array<int, 3> across{-1, -1, -1};
  std::array<std::uint8_t, 3> kind{};
};

/// Side `side` of triangle `triangle`.
struct Edge {
  int triangle = -1, side = 0;
  bool exists() const { return triangle >= 0; }
};

class Mesher {
 public:
  explicit Mesher(const std::vector<LatticePoint>& points) : points_(points), inner_(int(points.size())) {
    constexpr std::int64_t kFar = std::int64_t(1) << 24;  // all points lie well within this triangle
    points_.insert(points_.end(), {{-kFar, -kFar}, {2 * kFar, -kFar}, {-kFar, 2 * kFar}});
    triangle_at_.assign(points_.size(), 0);
    fan_.assign(points_.size(), -1);
    triangles_.push_back({.node = {inner_, inner_ + 1, inner_ + 2}});
  }

  bool insert(int p);
  bool recover(int from, int to, SegmentKind kind);
  void make_delaunay();
  std::optional<Triangulation> carve() const;

 private:
  std::int64_t side_of(int a, int b, int c) const { return orient(points_[a], points_[b], points_[c]); }
  int apex(Edge e) const { return triangles_[e.triangle].node[(e.side + 2) % 3]; }
  Edge twin(Edge e) const;
  Edge find(int from, int to) const;
  int locate(int p) const;
  void flip(Edge e);
  bool is_convex(Edge e) const;
  void relink(int neighbour, int was, int now);
  std::optional<std::deque<std::array<int, 2>>> crossings(int from, int to, int& blocking_node) const;

  std::vector<LatticePoint> points_;
  int inner_;  ///< the first of the three far nodes
  std::vector<Triangle> triangles_;
  std::vector<int> triangle_at_;  ///< a triangle of each node that is in
  std::vector<int> fan_;          ///< scratch of insert
  mutable int last_ = 0;          ///< where the next walk starts
};

Edge Mesher::twin(Edge e) const {
  const int other = triangles_[e.triangle].across[e.side];
  if (other < 0) return {};
  for (int i = 0; i < 3; ++i)
    if (triangles_[other].node[i] == triangles_[e.triangle].node[(e.side + 1) % 3]) return {other, i};
  return {};
}

/// The edge from -> to, searched around `from`.
Edge Mesher::find(int from, int to) const {
  const int first = triangle_at_[from];
  int t = first;
  do {
    const Triangle& triangle = triangles_[t];
    const int i = int(std::find(triangle.node.begin(), triangle.node.end(), from) - triangle.node.begin());
    if (triangle.node[(i + 1) % 3] == to) return {t, i};
    t = triangle.across[(i + 2) % 3];
  } while (t != first && t >= 0);
  return {};
}

/// Walks to a triangle that contains p. In a Delaunay triangulation the walk ends.
int Mesher::locate(int p) const {
  int t = last_;
  for (bool moved = true; moved;) {
    moved = false;
    for (int i = 0; i < 3 && !moved; ++i)
      if (side_of(triangles_[t].node[i], triangles_[t].node[(i + 1) % 3], p) < 0) {
        t = triangles_[t].across[i];
        moved = true;
      }
  }
  return last_ = t;
}

/// Bowyer and Watson: the triangles whose circle contains p make room for a fan around p.
bool Mesher::insert(int p) {
  const int start = locate(p);
  for (const int node : triangles_[start].node)
    if (points_[node] == points_[p]) return false;

  std::vector<int> hole{start};
  std::vector<std::uint8_t> in_hole(triangles_.size(), 0);
  in_hole[start] = 1;
  struct Rim {
    int from, to, outside;
  };
  std::vector<Rim> rim;
  for (std::size_t k = 0; k < hole.size(); ++k) {
    const Triangle triangle = triangles_[hole[k]];
    for (int i = 0; i < 3; ++i) {
      const int other = triangle.across[i];
      if (other >= 0 && in_hole[other]) continue;
      const auto circle = [&](const std::array<int, 3>& n) {
        return in_circle(points_[n[0]], points_[n[1]], points_[n[2]], points_[p]);
      };
      if (other >= 0 && circle(triangles_[other].node) > 0) {
        in_hole[other] = 1;
        hole.push_back(other);
      } else {
        rim.push_back({triangle.node[i], triangle.node[(i + 1) % 3], other});
      }
    }
  }
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const int t = k < hole.size() ? hole[k] : int(triangles_.size());
    if (k >= hole.size()) triangles_.emplace_back();
    triangles_[t] = {.node = {rim[k].from, rim[k].to, p}, .across = {rim[k].outside, -1, -1}};
    if (rim[k].outside >= 0) {
      Triangle& outside = triangles_[rim[k].outside];
      for (int i = 0; i < 3; ++i)
        if (outside.node[i] == rim[k].to) outside.across[i] = t;
    }
    fan_[rim[k].from] = t;
    triangle_at_[rim[k].from] = triangle_at_[p] = t;
  }
  for (const Rim& r : rim) {
    const int t = fan_[r.from], next = fan_[r.to];
    triangles_[t].across[1] = next;
    triangles_[next].across[2] = t;
  }
  last_ = triangle_at_[p];
  return true;
}

void Mesher::relink(int neighbour, int was, int now) {
  if (neighbour < 0) return;
  for (int& t : triangles_[neighbour].across)
    if (t == was) {
      t = now;
      return;
    }
}

//       c               c
//     /   \           / | \        the edge a -> b becomes d -> c
//    a-----b   -->   a  |  b
//     \   /           \ | /
//       d               d
void Mesher::flip(Edge e) {
  const Edge o = twin(e);
  const Triangle t = triangles_[e.triangle], u = triangles_[o.triangle];
  const int i = e.side, j = o.side;
  const int a = t.node[i], b = t.node[(i + 1) % 3], c = t.node[(i + 2) % 3], d = u.node[(j + 2) % 3];
  triangles_[e.triangle] = {{a, d, c},
                            {u.across[(j + 1) % 3], o.triangle, t.across[(i + 2) % 3]},
                            {u.kind[(j + 1) % 3], 0, t.kind[(i + 2) % 3]}};
  triangles_[o.triangle] = {{d, b, c},
                            {u.across[(j + 2) % 3], t.across[(i + 1) % 3], e.triangle},
                            {u.kind[(j + 2) % 3], t.kind[(i + 1) % 3], 0}};
  relink(u.across[(j + 1) % 3], o.triangle, e.triangle);
  relink(t.across[(i + 1) % 3], e.triangle, o.triangle);
  triangle_at_[a] = triangle_at_[d] = triangle_at_[c] = e.triangle;
  triangle_at_[b] = o.triangle;
}

/// True if the two triangles at the edge are a strictly convex quad.
bool Mesher::is_convex(Edge e) const {
  const int a = triangles_[e.triangle].node[e.side], b = triangles_[e.triangle].node[(e.side + 1) % 3];
  const int c = apex(e), d = apex(twin(e));
  return side_of(d, b, c) > 0 && side_of(a, d, c) > 0;
}

/// The edges that from -> to crosses, in order. Nothing if one of them is a segment; `blocking_node` is
/// set if the way leads through a node.
std::optional<std::deque<std::array<int, 2>>> Mesher::crossings(int from, int to, int& blocking_node) const {
  std::deque<std::array<int, 2>> crossed;
  Edge e;  // the edge of the first triangle that lies across the way
  int t = triangle_at_[from];
  do {
    const Triangle& triangle = triangles_[t];
    const int i = int(std::find(triangle.node.begin(), triangle.node.end(), from) - triangle.node.begin());
    const int right = triangle.node[(i + 1) % 3], left = triangle.node[(i + 2) % 3];
    const auto right_side = side_of(from, to, right), left_side = side_of(from, to, left);
    if (right_side == 0 && left_side > 0) {  // on the line, and ahead: behind, left would be to the right
      blocking_node = right;
      return crossed;
    }
    if (right_side < 0 && left_side > 0) {
      e = {t, (i + 1) % 3};
      break;
    }
    t = triangle.across[(i + 2) % 3];
  } while (t != triangle_at_[from]);

  while (true) {
    const Triangle& triangle = triangles_[e.triangle];
    if (triangle.kind[e.side] != 0) return std::nullopt;
    crossed.push_back({triangle.node[e.side], triangle.node[(e.side + 1) % 3]});
    const Edge o = twin(e);
    const int beyond = apex(o);
    if (beyond == to) return crossed;
    const auto side = side_of(from, to, beyond);
    if (side == 0) {
      blocking_node = beyond;
      return crossed;
    }
    e = {o.triangle, side < 0 ? (o.side + 2) % 3 : (o.side + 1) % 3};
  }
}

/// Makes from -> to an edge by flips (Sloan 1993) and marks it.
bool Mesher::recover(int from, int to, SegmentKind kind) {
  if (from == to) return false;
  if (!find(from, to).exists()) {
    int blocking_node = -1;
    auto crossed = crossings(from, to, blocking_node);
    if (blocking_node >= 0) return recover(from, blocking_node, kind) && recover(blocking_node, to, kind);
    if (!crossed) return false;
    while (!crossed->empty()) {
      const auto [a, b] = crossed->front();
      crossed->pop_front();
      const Edge e = find(a, b);
      if (!is_convex(e)) {
        crossed->push_back({a, b});
        continue;
      }
      const int c = apex(e), d = apex(twin(e));
      flip(e);
      if (c == from || c == to || d == from || d == to) continue;
      if ((side_of(from, to, c) > 0) != (side_of(from, to, d) > 0)) crossed->push_back({c, d});
    }
  }
  const Edge e = find(from, to), o = twin(e);
  triangles_[e.triangle].kind[e.side] |= std::uint8_t(kind);
  triangles_[o.triangle].kind[o.side] |= std::uint8_t(kind);
  return true;
}

/// Flips every edge that is no segment until it is Delaunay again.
void Mesher::make_delaunay() {
  for (bool changed = true; changed;) {
    changed = false;
    for (int t = 0; t < int(triangles_.size()); ++t)
      for (int i = 0; i < 3; ++i) {
        const Edge e{t, i};
        const Triangle& triangle = triangles_[t];
        if (triangle.kind[i] != 0 || triangle.across[i] < 0 || !is_convex(e)) continue;
        const auto& [a, b, c] = triangle.node;
        if (in_circle(points_[a], points_[b], points_[c], points_[apex(twin(e))]) <= 0) continue;
        flip(e);
        changed = true;
      }
  }
}

std::optional<Triangulation> Mesher::carve() const {
  std::vector<int> depth(triangles_.size(), -1);  // how many boundaries lie around it, even or odd
  std::vector<int> queue{triangle_at_[inner_]};
  depth[queue[0]] = 0;
  for (std::size_t k = 0; k < queue.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const int other = triangles_[queue[k]].across[i];
      if (other < 0) continue;
      const int there = depth[queue[k]] ^ (triangles_[queue[k]].kind[i] & std::uint8_t(SegmentKind::boundary));
      if (depth[other] >= 0 && depth[other] != there) return std::nullopt;
      if (depth[other] < 0) {
        depth[other] = there;
        queue.push_back(other);
      }
    }
  Triangulation result;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (depth[t] != 1) continue;
    result.triangles.push_back(triangles_[t].node);
    for (int i = 0; i < 3; ++i) {
      const int a = triangles_[t].node[i], b = triangles_[t].node[(i + 1) % 3], other = triangles_[t].across[i];
      const bool seen_from_both = other >= 0 && depth[other] == 1;
      if ((triangles_[t].kind[i] & std::uint8_t(SegmentKind::constraint)) && (a < b || !seen_from_both))
        result.constraints.push_back({a, b});
    }
  }
  return result;
}

}  // namespace

std::int64_t orient(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::optional<Triangulation> triangulate(const std::vector<LatticePoint>& points,
                                         const std::vector<Segment>& segments) {
  Mesher mesher(points);
  for (int p = 0; p < int(points.size()); ++p)
    if (!mesher.insert(p)) return std::nullopt;
  for (const Segment& s : segments)
    if (!mesher.recover(s.from, s.to, s.kind)) return std::nullopt;
  mesher.make_delaunay();
  return mesher.carve();
}

}  // namespace qmorph::test
